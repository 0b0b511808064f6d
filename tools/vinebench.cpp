// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <malloc.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <string>
#include <system_error>
#include <vector>

#include "core/util/pin_arithmetic.h"
#include "core/util/warning.h"
#include "harness/systems/plugin_process.h"
#include "tools/arguments/command_line.h"
#include "tools/arguments/completion.h"
#include "tools/commands/commands.h"
#include "tools/outcome.h"
#include "tools/versions.h"

namespace vinebench::tools {
namespace {

/// Memory of images that were freed stays with the program: asking the system for it anew costs a
/// tenth of a start's CPU time and a twentieth of a run's.
void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // bytes, the most that it takes
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  mallopt(M_TOP_PAD, 64 << 20);
#endif
}

/// The running program's own file, for its data beside it.
std::filesystem::path program_file() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error);
}

/// The first one alone: some commands need plants several times, and the reason stays the same.
void print_notice(const std::string& text) {
  static std::once_flag printed;
  std::call_once(printed, [&] { fmt::print(stderr, "vinebench: {}\n", text); });
}

int print_completions(const Command& program, std::vector<std::string> words,
                      const harness::Catalogue& catalogue) {
  words.erase(words.begin());
  if (!words.empty() && words.front() == "--") words.erase(words.begin());
  for (const std::string& candidate : complete(program, words, catalogue)) {
    fmt::print("{}\n", candidate);
  }
  return 0;
}

int main(const std::vector<std::string>& arguments) {
  keep_freed_memory();
  Surroundings surroundings{harness::Catalogue(harness::data_folders(program_file())),
                            harness::machine_of_environment()};
  surroundings.machine.plant_cache.notice = print_notice;
  surroundings.data_folders = harness::program_data_folders(program_file());
  surroundings.machine.plugin_host = harness::find_plugin_host(program_file());
  const Command commands = program(surroundings);
  if (!arguments.empty() && arguments.front() == kCompleteCommand) {
    return print_completions(commands, arguments, surroundings.catalogue);
  }
  return run_command_line(commands, arguments, surroundings.catalogue,
                          [&] { return versions_text(surroundings.machine); });
}

/// What was printed may still be in a buffer, and may not have a place where it goes.
int checked_output(int code) {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  fmt::print(stderr, "vinebench: standard output: cannot be written{}{}\n", errno != 0 ? ": " : "",
             errno != 0 ? std::strerror(errno) : "");
  return code <= kExpectationFailed ? kBadInput : code;
}

}  // namespace
}  // namespace vinebench::tools

int main(int argc, char** argv) {
  vinebench::pin_arithmetic();
  vinebench::set_warning_sink(
      [](const std::string& text) { fmt::print(stderr, "vinebench: warning: {}\n", text); });
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  return vinebench::tools::outcome_of(arguments, [&] {
    using vinebench::tools::checked_output;
    try {
      return checked_output(vinebench::tools::main(arguments));
    } catch (const std::exception&) {
      if (std::ferror(stdout) != 0) return checked_output(0);  // thrown while printing
      throw;
    }
  });
}
