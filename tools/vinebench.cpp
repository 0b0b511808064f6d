// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "core/util/error.h"
#include "harness/systems/plugin_process.h"
#include "tools/arguments/command_line.h"
#include "tools/arguments/completion.h"
#include "tools/commands/commands.h"
#include "tools/versions.h"

namespace vinebench::tools {
namespace {

/// The running program's own file, for its data beside it.
std::filesystem::path program_file() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error);
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
  Surroundings surroundings{harness::Catalogue(harness::data_folders(program_file())),
                            harness::machine_of_environment()};
  surroundings.data_folders = harness::program_data_folders(program_file());
  surroundings.machine.plugin_host = harness::find_plugin_host(program_file());
  const Command commands = program(surroundings);
  if (!arguments.empty() && arguments.front() == kCompleteCommand) {
    return print_completions(commands, arguments, surroundings.catalogue);
  }
  return run_command_line(commands, arguments, surroundings.catalogue,
                          [&] { return versions_text(surroundings.machine); });
}

}  // namespace
}  // namespace vinebench::tools

int main(int argc, char** argv) {
  try {
    return vinebench::tools::main({argv + 1, argv + argc});
  } catch (const vinebench::Error& error) {
    fmt::print(stderr, "vinebench: {}\n", error.what());
    return vinebench::tools::kBadInput;
  } catch (const std::exception& error) {
    fmt::print(stderr, "vinebench: internal error: {}\n", error.what());
    return vinebench::tools::kInternalError;
  }
}
