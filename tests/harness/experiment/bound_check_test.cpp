// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/experiment/bound_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

const fs::path kScenarios = fs::path(VINEBENCH_SOURCE_DIR) / "scenarios";

std::vector<std::string> keys_of(const ScenarioConfig& scenario) {
  std::vector<std::string> keys;
  for (const IneffectiveBound& bound : ineffective_bounds(scenario)) {
    keys.push_back(bound.part + "." + bound.key);
  }
  return keys;
}

/// quick-loop, which drives 1.3 m away from its start and returns to its tag once.
class BoundCheckTest : public testing::Test {
 protected:
  void SetUp() override {
    scenario_ = load_scenario(kScenarios / "quick-loop.yaml");
    scenario_.goal = {};
    scenario_.guard.reset();
  }
  ScenarioConfig scenario_;
};

TEST(BoundCheckScenariosTest, NoBoundOfOurScenariosIsIneffective) {
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kScenarios)) {
    if (entry.path().extension() != ".yaml") continue;
    if (entry.path().parent_path().filename() == "randomisation") continue;
    ++files;
    for (const IneffectiveBound& bound : ineffective_bounds(load_scenario(entry.path()))) {
      ADD_FAILURE() << entry.path().string() << ": " << bound.text();
    }
  }
  EXPECT_GT(files, 40);
}

// From (3.42, 0) to (4.5, 0.5) and back.
TEST_F(BoundCheckTest, TheDriveIsTheRoutes) {
  const RouteOutlook drive = route_outlook(scenario_);
  EXPECT_NEAR(drive.reach, std::hypot(1.08, 0.5), 1e-3);
  EXPECT_EQ(drive.returns, 1);
}

TEST_F(BoundCheckTest, OneReturnAllowsNoMissedClosure) {
  scenario_.goal.loop_closures_missed_max = 0;
  EXPECT_TRUE(keys_of(scenario_).empty());
  scenario_.goal.loop_closures_missed_max = 1;
  EXPECT_THAT(keys_of(scenario_), testing::ElementsAre("goal.loop_closures_missed_max"));
  EXPECT_EQ(ineffective_bounds(scenario_)[0].text(),
            "goal.loop_closures_missed_max: this bound cannot fail: the route returns to tags 1 "
            "times");
}

TEST_F(BoundCheckTest, CountsAndSharesOfNothing) {
  scenario_.expectations.coverage_min = 0;
  scenario_.expectations.loop_closures_correct_min = 0;
  scenario_.expectations.loop_closures_wrong_max = 1;
  scenario_.expectations.nees_mean_min = 0;
  scenario_.expectations.blind = {.cameras = {"front_left"}, .inliers_drop = 0.0};
  EXPECT_THAT(keys_of(scenario_),
              testing::ElementsAre("expectations.coverage_min", "expectations.nees_mean_min",
                                   "expectations.loop_closures_correct_min",
                                   "expectations.blind.inliers_drop"));
}

// A loss needs a frame with a pose and one without.
TEST_F(BoundCheckTest, MoreLossesThanFramesAllow) {
  const int most = route_outlook(scenario_).frames / 2;
  scenario_.guard.emplace().bounds.losses_max = most - 1;
  EXPECT_TRUE(keys_of(scenario_).empty());
  scenario_.guard->bounds.losses_max = most;
  EXPECT_THAT(keys_of(scenario_), testing::ElementsAre("guard.losses_max"));
}

TEST_F(BoundCheckTest, ErrorsThatNoEstimateHas) {
  scenario_.goal.ate_rmse_max = 1.1;  // standing still is at most 1.19 m off
  scenario_.goal.heading_rmse_max_deg = 179;
  EXPECT_TRUE(keys_of(scenario_).empty());
  scenario_.goal.ate_rmse_max = 1.2;
  scenario_.goal.heading_rmse_max_deg = 180;
  EXPECT_THAT(keys_of(scenario_),
              testing::ElementsAre("goal.ate_rmse_max", "goal.heading_rmse_max_deg"));
}

TEST_F(BoundCheckTest, AMedianAboveTheBoundOfEachRun) {
  scenario_.goal.ate_rmse_max = 0.01;
  scenario_.goal.median.emplace().ate_rmse_max = 0.009;
  EXPECT_TRUE(keys_of(scenario_).empty());
  scenario_.goal.median->ate_rmse_max = 0.01;
  EXPECT_THAT(keys_of(scenario_), testing::ElementsAre("goal.median.ate_rmse_max"));
}

}  // namespace
}  // namespace vinebench::harness
