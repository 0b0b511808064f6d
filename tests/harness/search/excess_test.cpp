// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/search/excess.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

class ExcessTest : public testing::Test {
 protected:
  ExcessTest() {
    goal_.ate_origin_rmse_max = 0.02;
    goal_.losses_max = 0;
    expectations_.coverage_min = 0.8;
  }
  double excess(double error, double losses, double coverage, const std::string& only = "") const {
    StoredRun run;
    run.values = {{"/ate_origin_rmse_m", error}, {"/losses", losses}, {"/coverage", coverage}};
    return excess_of(run, expectations_, goal_, only);
  }

  Expectations expectations_;
  Expectations goal_;
};

TEST_F(ExcessTest, TheWorstBoundByItsBinaryLogarithm) {
  EXPECT_DOUBLE_EQ(excess(0.08, 0, 1), 2);                      // four times the error
  EXPECT_DOUBLE_EQ(excess(0.015, 0, 0.4), 1);                   // half of the coverage
  EXPECT_DOUBLE_EQ(excess(0.0141421356237309505, 0, 1), -0.5);  // a root of a half
}

TEST_F(ExcessTest, CountsThatHoldAreNotNear) {
  EXPECT_DOUBLE_EQ(excess(0.0001, 0, 0.8), -1);
  EXPECT_GT(excess(0.0001, 1, 1), 0);
}

TEST_F(ExcessTest, OfOneBoundAlone) {
  EXPECT_LT(excess(0.01, 3, 1, "ate_origin_rmse_max"), 0);
  EXPECT_GT(excess(0.01, 3, 1, "losses_max"), 0);
}

// A system that gave no pose has no error.
TEST_F(ExcessTest, WhatWasNotMeasuredIsFarBeyond) {
  StoredRun run;
  run.values = {{"/losses", 0}, {"/coverage", 1}};
  EXPECT_DOUBLE_EQ(excess_of(run, expectations_, goal_, ""), 4);
}

TEST_F(ExcessTest, AsksForABoundThatTheScenarioHas) {
  EXPECT_NO_THROW(check_bound("losses_max", expectations_, goal_));
  EXPECT_THAT(test::error_of([&] { check_bound("loses_max", expectations_, goal_); }),
              testing::HasSubstr("did you mean 'losses_max'"));
  EXPECT_THAT(test::error_of([&] { check_bound("drift_max", expectations_, goal_); }),
              testing::HasSubstr("expected 'failure' or a bound"));
}

}  // namespace
}  // namespace vinebench::harness
