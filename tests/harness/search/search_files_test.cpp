// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/search/search_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/fake_search.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using testing::HasSubstr;

class SearchFilesTest : public testing::Test {
 protected:
  SearchFilesTest()
      : fake_([](const ScenarioConfig& scenario, std::int64_t) {
          return test::speed_of(scenario) > 0.9 ? 0.1 : 0.01;
        }),
        runs_(fake_.runs()) {
    fake_.problem.system = {{"slam.cameras", "front"}};
    SearchSettings settings;
    settings.seeds = {1, 2};
    settings.proof_seeds = 3;
    example_ = *search(runs_, settings, test::tell_nobody);
  }

  test::FakeSearch fake_;
  SearchRuns runs_;
  CounterExample example_;
};

// The system's own settings are not the scenario's: any other is run in it.
TEST_F(SearchFilesTest, TheScenarioIsWhatWasFound) {
  const test::TestFolder folder;
  const std::string text = counter_example_yaml(runs_, example_);
  const ScenarioConfig read = load_scenario(folder.write("found.yaml", text));
  EXPECT_EQ(read.name, "short-drive-counter-example");
  EXPECT_GT(test::speed_of(read), 0.9);
  EXPECT_LE(test::speed_of(read), 0.96);
  EXPECT_EQ(read.slam.cameras, ScenarioConfig{}.slam.cameras);
  EXPECT_EQ(read.goal.ate_origin_rmse_max, 0.03);
  EXPECT_THAT(text, HasSubstr("#   route.speed: 0.9"));
}

TEST_F(SearchFilesTest, TheReportTellsWhatWasProven) {
  const std::string text = search_report(runs_, example_);
  EXPECT_THAT(text, HasSubstr("Proof: 3 of 3 other seeds agree"));
  EXPECT_THAT(text, HasSubstr("`slam.cameras=front`"));
  EXPECT_THAT(text, HasSubstr("| 102 "));
}

TEST_F(SearchFilesTest, TheListHasEveryRunOnce) {
  const std::string text = search_csv(runs_);
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(text, '\n')), runs_.count() + 1);
  EXPECT_THAT(text, HasSubstr("\nsystem,1,0,,,0,0,0,passed,"));
}

}  // namespace
}  // namespace vinebench::harness
