// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/config/config_field.h"
#include "harness/catalogue/catalogue.h"
#include "harness/machine.h"

namespace vinebench::tools {

// A command of the command line as a value. `command_line.h` parses arguments by it,
// `completion.h` completes them.

inline constexpr int kExpectationFailed = 1;
inline constexpr int kBadInput = 2;
inline constexpr int kInternalError = 3;

/// Where an option's value goes: a flag, a number, a text, or several texts.
using OptionTarget = std::variant<bool*, int*, std::int64_t*, double*, std::optional<std::int64_t>*,
                                  std::string*, std::filesystem::path*, std::vector<std::string>*>;

/// What an option's text must name.
enum class Existing { kAnything, kFile, kFolder };

/// An option ("--out"), or an argument without a name of its own ("SCENARIO").
struct Option {
  std::string name;
  OptionTarget target;
  std::string help;
  std::string type{};  ///< in the help, such as "FILE"; by the target where empty
  bool required = false;
  bool commas = false;  ///< several texts may be one, with commas between them
  bool show_default = false;
  std::optional<Range> range{};
  std::vector<std::string> choices{};
  Existing existing = Existing::kAnything;
  std::string excludes{};                   ///< the option that must not stand beside this one
  std::string if_bare{};                    ///< its value where it stands alone
  std::optional<harness::DataKind> data{};  ///< it is a file of this kind, or the name of one
};

struct Command {
  std::string name;
  std::string description;
  std::vector<Option> options{};
  std::string footer{};
  /// Returns the program's exit code; the options' targets are set before.
  std::function<int()> run{};
  std::vector<Command> commands{};  ///< one of them is required where there are any
  bool any_arguments = false;       ///< also takes what no option describes
};

/// What commands are given beside their arguments.
struct Surroundings {
  harness::Catalogue catalogue;
  harness::Machine machine;
  /// The program's own data, without the working directory's.
  std::vector<std::filesystem::path> data_folders{};
};

}  // namespace vinebench::tools
