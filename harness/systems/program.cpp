// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/systems/program.h"

#include <chrono>

#include "core/files/input_file.h"
#include "core/util/error.h"
#include "harness/systems/process_group.h"

namespace vinebench::harness {
namespace {

constexpr std::chrono::milliseconds kLook{20};

std::string last_line_of(const std::filesystem::path& log) {
  std::string last;
  try {
    InputStream in(log, FileKind::kPart);
    for (std::string line; std::getline(in, line);) {
      if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
    }
  } catch (const Error&) {  // what the program failed of says more
    return fmt::format("; its messages are in {}", log.string());
  }
  return last.empty() ? "; it printed nothing"
                      : fmt::format("; its last line in {}: {}", log.string(), last);
}

/// Why it must end now; empty if it need not.
std::string exceeded_limit(const Program& program, ProcessGroup& process,
                           std::chrono::steady_clock::time_point start) {
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  if (spent.count() > program.timeout) return fmt::format("took more than {} s", program.timeout);
  if (process.exceeds_memory(program.memory_mib)) {
    return fmt::format("used more than {} MiB of memory", program.memory_mib);
  }
  return "";
}

}  // namespace

bool run_program(const Program& program) {
  const auto start = std::chrono::steady_clock::now();
  ProcessGroup process({.file = program.file,
                        .arguments = program.arguments,
                        .environment = program.environment,
                        .folder = program.folder,
                        .log = program.log});
  while (!process.wait(kLook)) {
    if (program.stopped && program.stopped()) return false;
    const std::string exceeded = exceeded_limit(program, process, start);
    if (exceeded.empty()) continue;
    process.kill();
    fail("{}: {}{}", program.file.string(), exceeded, last_line_of(program.log));
  }
  if (!process.succeeded()) {
    fail("{}: {}{}", program.file.string(), process.how_it_ended(), last_line_of(program.log));
  }
  return true;
}

}  // namespace vinebench::harness
