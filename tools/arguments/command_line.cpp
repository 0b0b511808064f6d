// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
//
// The one file that includes the argument parser, which takes seconds to compile.
#include "tools/arguments/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <type_traits>

#include "core/util/error.h"
#include "core/util/suggestion.h"

namespace vinebench::tools {
namespace {

/// What an option of CLI11 was made from.
struct Parsed {
  const Option* option;
  CLI::Option* parser;
};

std::string check_range(const Range& range, const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool number = !text.empty() && *end == '\0';
  return number && range.contains(value) ? ""
                                         : fmt::format("expected {}, found {}", range.text(), text);
}

std::string check_choice(const std::vector<std::string>& choices, const std::string& text) {
  if (std::ranges::count(choices, text) > 0) return "";
  return fmt::format("expected one of {}, found {}{}", fmt::join(choices, ", "), text,
                     did_you_mean(text, choices));
}

void add_checks(const Option& option, CLI::Option& parser) {
  if (option.range) {
    parser.check(
        [range = *option.range](const std::string& text) { return check_range(range, text); });
  }
  if (!option.choices.empty()) {
    parser.check([&option](const std::string& text) { return check_choice(option.choices, text); });
  }
  if (option.existing == Existing::kFile) parser.check(CLI::ExistingFile);
  if (option.existing == Existing::kFolder) parser.check(CLI::ExistingDirectory);
}

bool is_named(const Option& option) {
  return option.name.starts_with('-');
}

CLI::Option& add_option(CLI::App& app, const Option& option) {
  CLI::Option* parser = std::visit(
      [&](auto* target) {
        if constexpr (std::is_same_v<decltype(target), bool*>) {
          return app.add_flag(option.name, *target, option.help);
        } else {
          return app.add_option(option.name, *target, option.help);
        }
      },
      option.target);
  const bool several = std::holds_alternative<std::vector<std::string>*>(option.target);
  if (several && option.commas) parser->delimiter(',');
  if (several && !option.commas && is_named(option)) {
    parser->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  }
  if (!option.type.empty()) parser->type_name(option.type);
  if (option.show_default) parser->capture_default_str();
  if (!option.if_bare.empty()) parser->expected(0, 1)->default_str(option.if_bare);
  parser->required(option.required);
  return *parser;
}

void add_options(CLI::App& app, const Command& command, std::vector<Parsed>& all) {
  for (const Option& option : command.options) {
    CLI::Option& parser = add_option(app, option);
    add_checks(option, parser);
    all.push_back({&option, &parser});
  }
  for (const Option& option : command.options) {
    if (option.excludes.empty()) continue;
    app.get_option(option.name)->excludes(app.get_option(option.excludes));
  }
}

void add_command(CLI::App& app, const Command& command, const Command*& chosen,
                 std::vector<Parsed>& options) {
  add_options(app, command, options);
  app.footer(command.footer);
  app.allow_extras(command.any_arguments);
  if (command.run) app.callback([&chosen, &command] { chosen = &command; });
  for (const Command& part : command.commands) {
    add_command(*app.add_subcommand(part.name, part.description), part, chosen, options);
  }
}

/// `help run` is `run --help`.
std::vector<std::string> help_last(std::vector<std::string> arguments) {
  if (arguments.empty() || arguments.front() != "help") return arguments;
  arguments.erase(arguments.begin());
  arguments.emplace_back("--help");
  return arguments;
}

/// The command that the arguments name, as far as they do.
const Command& named_command(const Command& program, const std::vector<std::string>& arguments,
                             std::string& path) {
  const Command* command = &program;
  for (const std::string& word : arguments) {
    const auto next = std::ranges::find(command->commands, word, &Command::name);
    if (next == command->commands.end()) break;
    command = &*next;
    path += (path.empty() ? "" : " ") + word;
  }
  return *command;
}

[[noreturn]] void refuse(const Command& program, const std::vector<std::string>& arguments,
                         const std::vector<std::string>& unexpected, const std::string& problem) {
  std::string path;
  const Command& command = named_command(program, arguments, path);
  const std::string where = path.empty() ? "" : path + ": ";
  const std::string help = path.empty() ? "vinebench help" : "vinebench help " + path;
  if (unexpected.empty()) fail("{}{} (see {})", where, problem, help);
  const std::string& word = unexpected.front();
  std::vector<std::string> names;
  if (word.starts_with('-')) {
    names = {"--help"};
    for (const Option& option : command.options) {
      if (is_named(option)) names.push_back(option.name);
    }
  } else {
    for (const Command& part : command.commands) names.push_back(part.name);
  }
  const std::string option_name = word.substr(0, word.find('='));
  fail("{}{}: {}{} (see {})", where, word,
       word.starts_with('-')       ? "no such option"
       : !command.commands.empty() ? "no such command"
                                   : "unexpected argument",
       did_you_mean(option_name, names), help);
}

void find_data(const std::vector<Parsed>& options, const harness::Catalogue& catalogue) {
  for (const auto& [option, parser] : options) {
    if (!option->data || parser->count() == 0) continue;
    const auto find = [&, kind = *option->data](const std::string& text) {
      return catalogue.find(kind, text).string();
    };
    std::visit(
        [&](auto* target) {
          using Target = std::remove_pointer_t<decltype(target)>;
          if constexpr (std::is_same_v<Target, std::vector<std::string>>) {
            std::ranges::transform(*target, target->begin(), find);
          } else if constexpr (std::is_same_v<Target, std::string>) {
            *target = find(*target);
          } else if constexpr (std::is_same_v<Target, std::filesystem::path>) {
            *target = find(target->string());
          }
        },
        option->target);
  }
}

}  // namespace

int run_command_line(const Command& program, std::vector<std::string> arguments,
                     const harness::Catalogue& catalogue,
                     const std::function<std::string()>& version) {
  arguments = help_last(std::move(arguments));
  CLI::App app{program.description, program.name};
  const Command* chosen = nullptr;
  std::vector<Parsed> options;
  add_command(app, program, chosen, options);
  app.require_subcommand(0, 1);
  app.set_version_flag("--version", version);
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
  try {
    app.parse(reversed);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    refuse(program, arguments, app.remaining(true), error.what());
  }
  if (chosen == nullptr) refuse(program, arguments, {}, "expected a command");
  find_data(options, catalogue);
  return chosen->run();
}

}  // namespace vinebench::tools
