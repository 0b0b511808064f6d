// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/arguments/completion.h"

#include <algorithm>

namespace vinebench::tools {
namespace {

bool takes_value(const Option& option) {
  return !std::holds_alternative<bool*>(option.target);
}

const Option* option_named(const Command& command, const std::string& word) {
  const auto found = std::ranges::find(command.options, word, &Option::name);
  return found == command.options.end() || !word.starts_with('-') ? nullptr : &*found;
}

/// The argument without a name that comes after `before` others.
const Option* argument_at(const Command& command, std::size_t before) {
  const Option* last = nullptr;
  for (const Option& option : command.options) {
    if (option.name.starts_with('-')) continue;
    last = &option;
    if (before == 0) return last;
    --before;
  }
  const bool several =
      last != nullptr && std::holds_alternative<std::vector<std::string>*>(last->target);
  return several ? last : nullptr;
}

void add_values(const Option& option, const harness::Catalogue& catalogue,
                std::vector<std::string>& candidates) {
  candidates.insert(candidates.end(), option.choices.begin(), option.choices.end());
  if (option.data) {
    for (const harness::DataEntry& entry : catalogue.list(*option.data)) {
      candidates.push_back(entry.name);
    }
  }
  const bool number = std::holds_alternative<int*>(option.target) ||
                      std::holds_alternative<std::int64_t*>(option.target) ||
                      std::holds_alternative<double*>(option.target);
  if (option.existing == Existing::kFolder) {
    candidates.emplace_back(":folders");
  } else if (option.choices.empty() && !number) {
    candidates.emplace_back(":files");
  }
}

/// The command that the words lead to, what stands between them, and what awaits the last word.
struct Position {
  const Command* command;
  std::size_t arguments = 0;       ///< without a name, before the last word
  const Option* option = nullptr;  ///< whose value the last word is
};

Position position_of(const Command& program, const std::vector<std::string>& words) {
  Position position{&program};
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    if (position.option != nullptr) {
      position.option = nullptr;
      continue;
    }
    const auto& parts = position.command->commands;
    const auto next = std::ranges::find(parts, words[i], &Command::name);
    if (next != parts.end()) {
      position = {&*next};
    } else if (words[i].starts_with('-')) {
      const Option* option = option_named(*position.command, words[i]);
      if (option != nullptr && takes_value(*option)) position.option = option;
    } else {
      ++position.arguments;
    }
  }
  return position;
}

}  // namespace

std::vector<std::string> complete(const Command& program, const std::vector<std::string>& words,
                                  const harness::Catalogue& catalogue) {
  const std::string word = words.empty() ? "" : words.back();
  const Position at = position_of(program, words);
  std::vector<std::string> candidates;
  if (at.option != nullptr) {
    add_values(*at.option, catalogue, candidates);
  } else if (word.starts_with('-')) {
    for (const Option& option : at.command->options) {
      if (option.name.starts_with('-')) candidates.push_back(option.name);
    }
    candidates.emplace_back("--help");
    if (at.command == &program) candidates.emplace_back("--version");
  } else {
    for (const Command& part : at.command->commands) candidates.push_back(part.name);
    const Option* argument = argument_at(*at.command, at.arguments);
    if (argument != nullptr) add_values(*argument, catalogue, candidates);
  }
  std::erase_if(candidates, [&](const std::string& candidate) {
    return !candidate.starts_with(':') && !candidate.starts_with(word);
  });
  return candidates;
}

}  // namespace vinebench::tools
