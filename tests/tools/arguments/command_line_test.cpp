// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/arguments/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace vinebench::tools {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A program with one command of every kind of option, and one with parts.
class CommandLineTest : public ::testing::Test {
 protected:
  int run(const std::vector<std::string>& arguments) {
    return run_command_line(program(), arguments, catalogue_, [] { return "1.2.3"; });
  }
  std::string error(const std::vector<std::string>& arguments) {
    return test::error_of([&] { run(arguments); });
  }
  std::string help(const std::vector<std::string>& arguments) {
    testing::internal::CaptureStdout();
    const int code = run(arguments);
    const std::string text = testing::internal::GetCapturedStdout();
    EXPECT_EQ(code, 0);
    return text;
  }
  Command program() {
    Command drive{
        .name = "drive",
        .description = "Drive the rover",
        .options = {{.name = "SCENARIO",
                     .target = &scenarios_,
                     .help = "Which",
                     .required = true,
                     .data = harness::DataKind::kScenario},
                    {.name = "--speed",
                     .target = &speed_,
                     .help = "m/s",
                     .show_default = true,
                     .range = Range::between(0, 2)},
                    {.name = "--seed", .target = &seed_, .help = "Seed", .excludes = "--seeds"},
                    {.name = "--seeds", .target = &seeds_, .help = "Seeds"},
                    {.name = "--weather",
                     .target = &weather_,
                     .help = "Weather",
                     .choices = {"sunny", "rainy"}},
                    {.name = "--set", .target = &settings_, .help = "Settings"},
                    {.name = "--labels", .target = &labels_, .help = "Labels", .commas = true},
                    {.name = "--fast", .target = &fast_, .help = "At full speed"}},
        .footer = "Exit code: always 7.",
        .run = [] { return 7; }};
    Command wash{.name = "wash", .description = "Wash it", .run = [] { return 8; }};
    Command care{.name = "care", .description = "Care for the rover", .commands = {wash}};
    Command refuse{
        .name = "fly", .description = "Fly it", .run = [] { return 9; }, .any_arguments = true};
    return {.name = "rover", .description = "A rover", .commands = {drive, care, refuse}};
  }

  test::TestFolder folder_;
  std::string scenario_ = (folder_.write("row.yaml", "name: row\n")).string();
  harness::Catalogue catalogue_{{folder_.path()}};
  std::vector<std::string> scenarios_;
  double speed_ = 0.5;
  std::optional<std::int64_t> seed_;
  std::string seeds_;
  std::string weather_;
  std::vector<std::string> settings_;
  std::vector<std::string> labels_;
  bool fast_ = false;
};

TEST_F(CommandLineTest, SetsTargetsAndReturnsTheCommandsCode) {
  EXPECT_EQ(
      run({"drive", scenario_, "--speed", "1.5", "--seed", "3", "--weather", "rainy", "--fast"}),
      7);
  EXPECT_THAT(scenarios_, ElementsAre(scenario_));
  EXPECT_EQ(speed_, 1.5);
  EXPECT_EQ(seed_, 3);
  EXPECT_EQ(weather_, "rainy");
  EXPECT_TRUE(fast_);
}

TEST_F(CommandLineTest, OptionsThatAreNotGivenKeepTheirDefaults) {
  run({"drive", scenario_});
  EXPECT_EQ(speed_, 0.5);
  EXPECT_EQ(seed_, std::nullopt);
  EXPECT_THAT(settings_, IsEmpty());
  EXPECT_FALSE(fast_);
}

TEST_F(CommandLineTest, ASettingTakesOneTextEachTimeAndMayHaveCommas) {
  run({"drive", "--set", "a=[1,2]", "--set", "b=3", scenario_});
  EXPECT_THAT(settings_, ElementsAre("a=[1,2]", "b=3"));
  EXPECT_THAT(scenarios_, ElementsAre(scenario_));
}

TEST_F(CommandLineTest, CommasSeparateWhereTheOptionSaysSo) {
  run({"drive", scenario_, "--labels", "post,bunch"});
  EXPECT_THAT(labels_, ElementsAre("post", "bunch"));
}

TEST_F(CommandLineTest, NamesOfDataBecomeTheirFiles) {
  std::filesystem::create_directories(folder_ / "scenarios");
  folder_.write("scenarios/hill.yaml", "name: hill\n");
  run({"drive", "hill", scenario_});
  EXPECT_THAT(
      scenarios_,
      ElementsAre((std::filesystem::canonical(folder_.path()) / "scenarios/hill.yaml").string(),
                  scenario_));
  EXPECT_THAT(error({"drive", "hil"}), HasSubstr("did you mean 'hill'?"));
}

TEST_F(CommandLineTest, ACommandMayHaveParts) {
  EXPECT_EQ(run({"care", "wash"}), 8);
  EXPECT_EQ(error({"care"}), "care: expected a command (see vinebench help care)");
  EXPECT_EQ(error({"care", "wahs"}),
            "care: wahs: no such command; did you mean 'wash'? (see vinebench help care)");
}

TEST_F(CommandLineTest, WrongValuesAreRefusedWithWhatWasExpected) {
  EXPECT_THAT(error({"drive", scenario_, "--speed", "3"}), HasSubstr("found 3"));
  EXPECT_THAT(error({"drive", scenario_, "--speed", "fast"}), HasSubstr("--speed"));
  EXPECT_THAT(error({"drive", scenario_, "--weather", "suny"}),
              HasSubstr("expected one of sunny, rainy, found suny; did you mean 'sunny'?"));
  EXPECT_THAT(error({"drive", scenario_, "--seed", "1", "--seeds", "1..2"}), HasSubstr("--seeds"));
  EXPECT_THAT(error({"drive"}), HasSubstr("SCENARIO is required"));
}

TEST_F(CommandLineTest, UnknownWordsAreToldTheNearest) {
  EXPECT_EQ(error({"driev"}), "driev: no such command; did you mean 'drive'? (see vinebench help)");
  EXPECT_EQ(error({"drive", scenario_, "--sped=1"}),
            "drive: --sped=1: no such option; did you mean '--speed'? (see vinebench help drive)");
  EXPECT_EQ(error({}), "expected a command (see vinebench help)");
}

TEST_F(CommandLineTest, HelpOfTheProgramAndOfACommand) {
  EXPECT_THAT(help({"help"}), HasSubstr("Drive the rover"));
  const std::string drive = help({"help", "drive"});
  EXPECT_EQ(drive, help({"drive", "--help"}));
  EXPECT_THAT(drive, HasSubstr("--weather"));
  EXPECT_THAT(drive, HasSubstr("0.5"));  // the default
  EXPECT_THAT(drive, HasSubstr("Exit code: always 7."));
  EXPECT_THAT(help({"help", "care", "wash"}), HasSubstr("Wash it"));
  EXPECT_THAT(help({"--version"}), HasSubstr("1.2.3"));
}

TEST_F(CommandLineTest, ACommandMayTakeAnything) {
  EXPECT_EQ(run({"fly", "high", "--far", "1"}), 9);
}

}  // namespace
}  // namespace vinebench::tools
