// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tools/commands/commands.h"

namespace vinebench::tools {
namespace {

/// Each command with its parts, by its whole name.
void collect(const Command& command, const std::string& prefix,
             std::vector<std::pair<std::string, Command>>& all) {
  for (const Command& part : command.commands) {
    all.emplace_back(prefix + part.name, part);
    collect(part, prefix + part.name + " ", all);
  }
}

class ProgramTest : public ::testing::Test {
 protected:
  ProgramTest() { collect(program_, "", commands_); }

  Command program_ = program({});
  std::vector<std::pair<std::string, Command>> commands_;
};

TEST_F(ProgramTest, EveryCommandIsDescribedAndDoesSomething) {
  EXPECT_GE(commands_.size(), 14U);
  for (const auto& [name, command] : commands_) {
    EXPECT_FALSE(command.description.empty()) << name;
    EXPECT_EQ(static_cast<bool>(command.run), command.commands.empty()) << name;
  }
}

TEST_F(ProgramTest, OptionsHaveAHelpATargetAndANameOfTheirOwn) {
  for (const auto& [name, command] : commands_) {
    std::set<std::string> names;
    for (const Option& option : command.options) {
      EXPECT_TRUE(names.insert(option.name).second) << name << " " << option.name;
      EXPECT_FALSE(option.help.empty()) << name << " " << option.name;
      std::visit([&](const auto* target) { EXPECT_NE(target, nullptr) << name << option.name; },
                 option.target);
    }
  }
}

TEST_F(ProgramTest, CommandsThatNeedPlantsTakeACache) {
  std::set<std::string> with_cache;
  for (const auto& [name, command] : commands_) {
    if (std::ranges::count(command.options, "--cache", &Option::name) > 0) with_cache.insert(name);
  }
  EXPECT_EQ(with_cache, (std::set<std::string>{"guard", "explain", "run", "realism", "record",
                                               "render", "bench render", "bench slam",
                                               "bench record", "dataset", "search", "sweep run"}));
}

TEST_F(ProgramTest, WhatAnOptionExcludesIsAnOptionOfTheSameCommand) {
  for (const auto& [name, command] : commands_) {
    for (const Option& option : command.options) {
      if (option.excludes.empty()) continue;
      EXPECT_EQ(std::ranges::count(command.options, option.excludes, &Option::name), 1)
          << name << " " << option.name;
    }
  }
}

TEST_F(ProgramTest, ValidatesItsOwnDefaults) {
  for (const auto& [name, command] : commands_) {
    for (const Option& option : command.options) {
      if (!option.range) continue;
      if (const auto* target = std::get_if<int*>(&option.target)) {
        EXPECT_TRUE(option.range->contains(**target)) << name << " " << option.name;
      }
      if (const auto* target = std::get_if<std::string*>(&option.target)) {
        EXPECT_TRUE((*target)->empty()) << name << " " << option.name;
      }
    }
  }
}

}  // namespace
}  // namespace vinebench::tools
