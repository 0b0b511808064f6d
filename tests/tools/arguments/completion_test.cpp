// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/arguments/completion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace vinebench::tools {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class CompletionTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"hill", "row"}) {
      std::filesystem::create_directories(folder_ / "scenarios");
      folder_.write(std::string("scenarios/") + name + ".yaml", "");
    }
  }
  std::vector<std::string> completions(const std::vector<std::string>& words) {
    return complete(program(), words, harness::Catalogue({folder_.path()}));
  }
  Command program() {
    Command run{.name = "run",
                .description = "",
                .options = {{.name = "SCENARIO",
                             .target = &several_,
                             .help = "",
                             .data = harness::DataKind::kScenario},
                            {.name = "--jobs", .target = &number_, .help = ""},
                            {.name = "--out", .target = &text_, .help = ""},
                            {.name = "--force", .target = &flag_, .help = ""}}};
    Command list{
        .name = "list",
        .description = "",
        .options = {{.name = "KIND", .target = &text_, .help = "", .choices = {"worlds", "rigs"}}}};
    Command check{
        .name = "check",
        .description = "",
        .options = {
            {.name = "DATASET", .target = &text_, .help = "", .existing = Existing::kFolder}}};
    Command slam{.name = "slam", .description = ""};
    Command bench{.name = "bench", .description = "", .commands = {slam}};
    return {.name = "vinebench", .description = "", .commands = {run, list, check, bench}};
  }

  test::TestFolder folder_;
  std::vector<std::string> several_;
  std::string text_;
  int number_ = 0;
  bool flag_ = false;
};

TEST_F(CompletionTest, CommandsByTheirBeginning) {
  EXPECT_THAT(completions({""}), ElementsAre("run", "list", "check", "bench"));
  EXPECT_THAT(completions({"r"}), ElementsAre("run"));
  EXPECT_THAT(completions({"bench", ""}), ElementsAre("slam"));
  EXPECT_THAT(completions({}), ElementsAre("run", "list", "check", "bench"));
}

TEST_F(CompletionTest, Options) {
  EXPECT_THAT(completions({"run", "--"}), ElementsAre("--jobs", "--out", "--force", "--help"));
  EXPECT_THAT(completions({"run", "hill", "--f"}), ElementsAre("--force"));
  EXPECT_THAT(completions({"--"}), ElementsAre("--help", "--version"));
}

TEST_F(CompletionTest, NamesAndFilesOfScenarios) {
  EXPECT_THAT(completions({"run", ""}), ElementsAre("hill", "row", ":files"));
  EXPECT_THAT(completions({"run", "hill", "r"}), ElementsAre("row", ":files"));
  EXPECT_THAT(completions({"run", "--force", "h"}), ElementsAre("hill", ":files"));
}

TEST_F(CompletionTest, ValuesOfOptions) {
  EXPECT_THAT(completions({"run", "--out", ""}), ElementsAre(":files"));
  EXPECT_THAT(completions({"run", "--jobs", ""}), IsEmpty());
  EXPECT_THAT(completions({"run", "--jobs", "2", "h"}), ElementsAre("hill", ":files"));
}

TEST_F(CompletionTest, ChoicesAndFolders) {
  EXPECT_THAT(completions({"list", "w"}), ElementsAre("worlds"));
  EXPECT_THAT(completions({"check", ""}), ElementsAre(":folders"));
}

TEST_F(CompletionTest, NothingAfterTheLastArgument) {
  EXPECT_THAT(completions({"list", "worlds", ""}), IsEmpty());
}

}  // namespace
}  // namespace vinebench::tools
