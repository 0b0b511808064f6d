// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tools/arguments/command.h"

namespace vinebench::tools {

/// What the last of some words (after the program's name) may be completed to, for a shell:
/// commands, options, the values of an option with choices, names of scenarios and worlds. The
/// entry ":files" stands for the names of files, ":folders" for those of folders.
std::vector<std::string> complete(const Command& program, const std::vector<std::string>& words,
                                  const harness::Catalogue& catalogue);

/// The hidden command behind the shells' completion: `__complete WORD...` prints them.
inline constexpr const char* kCompleteCommand = "__complete";

}  // namespace vinebench::tools
