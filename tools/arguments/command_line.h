// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/arguments/command.h"

namespace vinebench::tools {

/// Parses arguments (without the program's name) by the tree of commands, and runs the command that
/// they name: `COMMAND ARGUMENTS`, `help [COMMAND]`, `--help`, `--version`. The texts of options
/// with `data` become the files that the catalogue finds. Returns the command's exit code. Throws
/// Error for arguments that do not fit, with the nearest name.
int run_command_line(const Command& program, std::vector<std::string> arguments,
                     const harness::Catalogue& catalogue,
                     const std::function<std::string()>& version);

}  // namespace vinebench::tools
