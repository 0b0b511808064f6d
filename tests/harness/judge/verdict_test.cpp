// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vinebench::harness {
namespace {

/// Results that meet every_check().
RunResults good() {
  RunResults results;
  results.coverage = 1;
  results.corrected.emplace();
  results.corrected->ate.rmse = 0.004;
  results.corrected->origin.rmse = 0.009;
  results.loops.closures.resize(1);
  results.loops.closures[0].judged = results.loops.closures[0].correct = true;
  results.blind = OcclusionSegment{.seconds = 4, .inliers_clear = 160, .inliers_blind = 8};
  return results;
}

Expectations every_check() {
  Expectations expectations;
  expectations.coverage_min = 1;
  expectations.losses_max = 0;
  expectations.ate_rmse_max = 0.01;
  expectations.ate_origin_rmse_max = 0.01;
  expectations.loop_closures_correct_min = 1;
  expectations.loop_closures_wrong_max = 0;
  expectations.loop_closures_missed_max = 0;
  expectations.blind = {.cameras = {"front_left"}, .seconds = 3, .inliers_drop = 0.9};
  return expectations;
}

std::vector<std::string> failures(const RunResults& results) {
  std::vector<std::string> names;
  for (const Check& check : failed_of(check_expectations(every_check(), results))) {
    names.push_back(check.what);
  }
  return names;
}

TEST(VerdictTest, HoldsForGoodResults) {
  const auto checks = check_expectations(every_check(), good());
  EXPECT_EQ(checks.size(), 9u);
  EXPECT_TRUE(all_hold(checks)) << format_checks(checks);
}

// "ok" stands in one column, though the first line is longer.
TEST(VerdictTest, ALongTextWidensNoOtherLine) {
  const std::string text = format_checks(
      {{"SLAM system", std::string(60, 'x'), "no failure", false}, {"losses", "0", "<= 0", true}});
  EXPECT_THAT(text, testing::EndsWith("\n  losses       0  <= 0        ok\n"));
}

TEST(VerdictTest, ABoundItselfHolds) {
  RunResults results = good();
  results.corrected->ate.rmse = 0.01;
  results.blind->seconds = 3;
  results.blind->inliers_blind = 16;  // 1 - 16 / 160 = 0.9
  EXPECT_TRUE(failures(results).empty());
  results.corrected->ate.rmse = 0.0101;
  results.blind->seconds = 2.99;
  results.blind->inliers_blind = 17;
  EXPECT_THAT(failures(results), testing::ElementsAre("ATE, SE(3)-aligned", "blind in motion",
                                                      "inliers' drop while blind"));
}

TEST(VerdictTest, NamesEachBrokenExpectation) {
  RunResults results = good();
  results.coverage = 0.99;
  results.losses = 1;
  results.loops.closures[0].correct = false;
  results.loops.missed.resize(1);
  EXPECT_THAT(failures(results),
              testing::ElementsAre("coverage", "losses", "loop closures, correct",
                                   "loop closures, wrong", "loop closures, missed"));
}

TEST(VerdictTest, WhatWasNotMeasuredFails) {
  RunResults results = good();
  results.corrected.reset();
  results.blind.reset();
  const auto failed = failed_of(check_expectations(every_check(), results));
  ASSERT_EQ(failed.size(), 4u);
  EXPECT_EQ(failed[0].what, "ATE, SE(3)-aligned");
  EXPECT_EQ(failed[0].measured, "none");
  EXPECT_EQ(failed[2].measured, "0.0000 s");  // never blind is 0 s of it
}

TEST(VerdictTest, NothingAskedHolds) {
  EXPECT_TRUE(check_expectations({}, {}).empty());
  EXPECT_TRUE(all_hold({}));
}

TEST(VerdictTest, AChecksTableLinesUp) {
  EXPECT_EQ(format_checks({{"a", "12 m", "<= 9 m", false}, {"longer", "1 m", "<= 2 m", true}}),
            "  a       12 m  <= 9 m  FAILED\n"
            "  longer   1 m  <= 2 m  ok\n");
}

TEST(VerdictTest, TellsGoalsFromGuards) {
  Trial trial;
  trial.expectations.losses_max = 0;
  trial.goal.ate_rmse_max = 0.01;
  trial.guard.ate_rmse_max = 0.002;  // good() has 0.004
  const auto checks = check_trial(trial, good());
  ASSERT_EQ(checks.size(), 3u);
  EXPECT_EQ(checks[0].kind, CheckKind::kExpectation);
  EXPECT_EQ(checks[1].kind, CheckKind::kGoal);
  EXPECT_EQ(checks[2].kind, CheckKind::kGuard);
  EXPECT_EQ(verdict_of(checks), "FAILED (guard)");
  EXPECT_EQ(format_checks(failed_of(checks)),
            "  guard        ATE, SE(3)-aligned  0.0040 m  <= 0.0020 m  FAILED\n");
  RunResults bad = good();
  bad.corrected.reset();
  EXPECT_EQ(verdict_of(check_trial(trial, bad)), "FAILED (goal, guard)");
  trial.guard = {};
  EXPECT_EQ(verdict_of(check_trial(trial, good())), "PASSED");
}

// good() has an ATE of 0.004 m.
TEST(VerdictTest, AGoalIsOpenWhileItsBoundForNowHolds) {
  Trial trial;
  trial.goal.ate_rmse_max = 0.003;
  EXPECT_EQ(verdict_of(check_trial(trial, good())), "FAILED (goal)");
  trial.now.ate_rmse_max = 0.005;
  const auto open = check_trial(trial, good());
  EXPECT_TRUE(all_hold(open));
  EXPECT_FALSE(open[0].ok);
  EXPECT_EQ(verdict_of(open), "PASSED (goal open)");
  EXPECT_TRUE(failed_of(open).empty());
  EXPECT_EQ(format_checks(open),
            "  goal         ATE, SE(3)-aligned  0.0040 m  <= 0.0030 m  open\n"
            "  now          ATE, SE(3)-aligned  0.0040 m  <= 0.0050 m  ok\n");
  trial.now.ate_rmse_max = 0.0035;
  EXPECT_EQ(verdict_of(check_trial(trial, good())), "FAILED (goal, now)");
  trial.goal.ate_rmse_max = 0.01;  // reached, but not what is expected now
  EXPECT_EQ(verdict_of(check_trial(trial, good())), "FAILED (now)");
}

TEST(VerdictTest, ABoundForNowOpensNoOtherGoal) {
  Trial trial;
  trial.goal.ate_rmse_max = 0.003;
  trial.goal.losses_max = 0;
  trial.now.losses_max = 3;
  EXPECT_EQ(verdict_of(check_trial(trial, good())), "FAILED (goal)");
}

TEST(VerdictTest, AUsersExpectationFailsWithoutAKind) {
  RunResults results = good();
  results.losses = 1;
  EXPECT_EQ(verdict_of(check_expectations(every_check(), results)), "FAILED");
  for (const CheckKind kind :
       {CheckKind::kExpectation, CheckKind::kGoal, CheckKind::kGuard, CheckKind::kNow}) {
    EXPECT_EQ(kind_of(name_of(kind)), kind);
  }
  EXPECT_EQ(kind_of(""), CheckKind::kExpectation);
}

}  // namespace
}  // namespace vinebench::harness
