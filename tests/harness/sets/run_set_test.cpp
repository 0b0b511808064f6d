// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sets/run_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <sstream>

#include "core/util/error.h"
#include "harness/sets/junit.h"
#include "harness/sets/set_report.h"
#include "tests/support/fake_scenario.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using testing::HasSubstr;

/// After the start the estimate is off sideways by `seed` centimetres.
RunOutcome slide(const ScenarioConfig& scenario, int, const RunOptions& options) {
  const double offset = 0.01 * static_cast<double>(scenario.seed);
  test::FakeSource source;
  test::FakeSlam slam([&](Estimate& estimate) {
    if (estimate.stamp > 0) estimate.T_map_body->translation.z() += offset;
  });
  return run_lockstep_and_judge(trial_of(scenario), source, slam, options);
}

class RunSetTest : public testing::Test {
 protected:
  RunSetTest() { options_.run = slide; }

  std::vector<PlannedRun> plan(const std::vector<std::int64_t>& seeds) const {
    return plan_set({scenario_}, seeds, folder_.path());
  }
  std::vector<SeedsSummary> run(const std::vector<std::int64_t>& seeds) {
    std::ostringstream progress;
    options_.progress = &progress;
    outcome_ = run_set(plan(seeds), options_);
    progress_ = progress.str();
    return summarise(plan(seeds), outcome_);
  }

  test::TestFolder folder_;
  ScenarioConfig scenario_ = test::fake_scenario();
  SetOptions options_;
  SetOutcome outcome_;
  std::string progress_;
};

TEST_F(RunSetTest, PlansEachScenarioOverTheSeeds) {
  ScenarioConfig other = scenario_;
  other.name = "other";
  other.seed = 9;
  const auto over_seeds = plan_set({scenario_, other}, {4, 2}, "out");
  ASSERT_EQ(over_seeds.size(), 4u);
  EXPECT_EQ(over_seeds[1].folder, "out/fake/seed-2");
  EXPECT_EQ(over_seeds[2].scenario.seed, 4);
  EXPECT_EQ(over_seeds[2].folder, "out/other/seed-4");
  const auto own = plan_set({scenario_, other}, {}, "out");
  ASSERT_EQ(own.size(), 2u);
  EXPECT_EQ(own[1].folder, "out/other/seed-9");
  EXPECT_THAT(test::error_of([&] {
                plan_set({scenario_, scenario_}, {}, "out");
              }),
              HasSubstr("the name 'fake'"));
}

// All but the first of 201 poses are 0.01 m times the seed too high.
TEST_F(RunSetTest, GivesEveryRunAndTheMedian) {
  options_.jobs = 2;
  const auto scenarios = run({1, 2, 3});
  ASSERT_EQ(scenarios.size(), 1u);
  ASSERT_EQ(scenarios[0].runs.size(), 3u);
  for (const SetRun& run : scenarios[0].runs) {
    EXPECT_EQ(run.error, "");
    EXPECT_FALSE(run.kept);
    const double expected = 0.01 * static_cast<double>(run.seed) * std::sqrt(200.0 / 201);
    EXPECT_NEAR(run.metrics["ate_origin_rmse_m"].get<double>(), expected, 1e-9);  // m
  }
  EXPECT_NEAR(scenarios[0].medians[0].value(), 20 * std::sqrt(200.0 / 201), 1e-6);  // mm
  EXPECT_TRUE(scenarios[0].passed());
  EXPECT_THAT(progress_, HasSubstr("[3/3] fake, seed "));
  EXPECT_THAT(read_file(folder_ / "fake/seed-2/log.txt"), HasSubstr("100%"));
}

TEST_F(RunSetTest, WhatIsThereIsKeptUnlessItsInputsDiffer) {
  run({1});
  const auto again = run({1, 2});
  EXPECT_TRUE(again[0].runs[0].kept);
  EXPECT_FALSE(again[0].runs[1].kept);
  EXPECT_EQ(again[0].runs[0].metrics["frames"], 201);
  EXPECT_THAT(progress_, HasSubstr("seed 1: passed (kept)"));

  options_.force = true;
  EXPECT_FALSE(run({1})[0].runs[0].kept);
  options_.force = false;
  scenario_.slam.tracking.radius += 1;
  EXPECT_FALSE(run({1})[0].runs[0].kept);
  EXPECT_TRUE(run({1})[0].runs[0].kept);
  folder_.write("fake/seed-1/metrics.json", "{\"frames\": 2");  // half a file
  EXPECT_FALSE(run({1})[0].runs[0].kept);
}

TEST_F(RunSetTest, ARunThatCrashesIsAnErrorOfItsOwn) {
  options_.run = [](const ScenarioConfig& scenario, int threads, const RunOptions& options) {
    if (scenario.seed == 2) raise(SIGKILL);
    return slide(scenario, threads, options);
  };
  const auto scenarios = run({1, 2, 3});
  EXPECT_FALSE(outcome_.interrupted);
  EXPECT_FALSE(scenarios[0].passed());
  EXPECT_EQ(scenarios[0].runs[1].error, "fake, seed 2: the process ended by signal 9");
  EXPECT_EQ(scenarios[0].runs[2].error, "");
  EXPECT_THAT(format_failures(scenarios), HasSubstr("log.txt"));
  EXPECT_THAT(format_junit(scenarios), HasSubstr("errors=\"1\""));
}

TEST_F(RunSetTest, AStopLeavesTheRestForAnotherTime) {
  options_.stopped = [&] { return std::filesystem::exists(folder_ / "fake/seed-1/inputs.txt"); };
  options_.run = [](const ScenarioConfig& scenario, int threads, const RunOptions& options) {
    RunOptions undisturbed = options;
    undisturbed.stopped = {};
    return slide(scenario, threads, undisturbed);
  };
  run({1, 2, 3});
  EXPECT_TRUE(outcome_.interrupted);
  options_.stopped = {};
  const auto again = run({1, 2, 3});
  EXPECT_FALSE(outcome_.interrupted);
  EXPECT_TRUE(again[0].runs[0].kept);
  EXPECT_FALSE(again[0].runs[2].kept);
}

// Errors of 10, 20 and 30 mm: each is below 35 mm, the median is not below 15 mm.
TEST_F(RunSetTest, TheMedianHasABoundOfItsOwn) {
  scenario_.expectations.ate_origin_rmse_max = 0.035;
  scenario_.expectations.median = {.ate_rmse_max = std::nullopt, .ate_origin_rmse_max = 0.015};
  const auto scenarios = run({1, 2, 3});
  EXPECT_FALSE(scenarios[0].runs[2].failed());
  EXPECT_FALSE(scenarios[0].passed());
  ASSERT_EQ(scenarios[0].checks.size(), 1u);
  EXPECT_EQ(scenarios[0].checks[0].what, "median of 3 seeds: ATE, first pose aligned");
  EXPECT_THAT(format_table(scenarios), HasSubstr("median"));
  EXPECT_THAT(format_junit(scenarios),
              testing::AllOf(HasSubstr("tests=\"4\" failures=\"1\" errors=\"0\""),
                             HasSubstr("name=\"median\"")));
  EXPECT_FALSE(summary_json(scenarios)["passed"].get<bool>());
  EXPECT_TRUE(run({1, 2})[0].checks.empty());  // too few for a median
}

TEST_F(RunSetTest, ABrokenExpectationIsInEveryReport) {
  scenario_.expectations.ate_rmse_max = 1e-6;
  const auto scenarios = run({1, 2});
  EXPECT_TRUE(scenarios[0].runs[0].failed());
  EXPECT_THAT(format_table(scenarios), HasSubstr("FAILED"));
  EXPECT_THAT(format_failures(scenarios), HasSubstr("ATE, SE(3)-aligned"));
  EXPECT_THAT(format_junit(scenarios),
              testing::AllOf(HasSubstr("failures=\"2\""), HasSubstr("&lt;= 0.0000 m")));
  EXPECT_EQ(summary_json(scenarios)["scenarios"][0]["runs"][0]["verdict"], "FAILED");
}

}  // namespace
}  // namespace vinebench::harness
