// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/odometry/wheel_accuracy.h"

#include <gtest/gtest.h>

namespace vinebench::slam {
namespace {

constexpr double kSlip = 0.05, kTurn = 0.04;

Pose ahead(double way) {
  return {Eigen::Quaterniond::Identity(), {way, 0, 0}};
}

class WheelAccuracyTest : public testing::Test {
 protected:
  WheelAccuracyTest() { accuracy_.see(T_map_body_); }

  /// Stretches of 0.25 m by the wheels, in four frames, where the cameras see this share more.
  void drive(int stretches, double more) {
    for (int i = 0; i < 4 * stretches; ++i) {
      accuracy_.roll(ahead(0.0625));
      T_map_body_ = T_map_body_ * ahead(0.0625 * (1 + more));
      accuracy_.see(T_map_body_);
    }
  }

  WheelAccuracy accuracy_{kSlip, kTurn};
  Pose T_map_body_{exp_so3({0.1, 0.2, 0.3}), {1, 2, 3}};
};

TEST_F(WheelAccuracyTest, BelievesWhatItWasToldUntilItSees) {
  drive(0, 0);
  EXPECT_EQ(accuracy_.errors().lasting[1], kSlip * kSlip);
  EXPECT_EQ(accuracy_.errors().lasting[5], kTurn * kTurn);
  EXPECT_TRUE(accuracy_.errors().passing.isZero());
}

TEST_F(WheelAccuracyTest, AWheelOfAnotherRadiusIsAnErrorThatLasts) {
  drive(40, 0.02);
  const WheelErrors errors = accuracy_.errors();
  // Of the 40 stretches' scatter, which is nothing, a fiftieth of what was told is left.
  EXPECT_NEAR(errors.passing[0], 0.02 * kSlip * kSlip / 39.02, 1e-12);
  // The mean of 2 %, a 0.02 / 39.02 / 40th part pulled to nothing, and its variance of a 40th.
  EXPECT_NEAR(std::sqrt(errors.lasting[0]), 0.02, 2e-5);
  EXPECT_LT(std::sqrt(errors.lasting[1]), 0.001);
  EXPECT_LT(std::sqrt(errors.lasting[5]), 0.001);
}

TEST_F(WheelAccuracyTest, WhatChangesFromStretchToStretchPasses) {
  for (int i = 0; i < 20; ++i) {
    drive(1, 0.02);
    drive(1, -0.02);
  }
  const WheelErrors errors = accuracy_.errors();
  // 40 squares of 2 % over 39, beside the fiftieth of what was told.
  const double passing = (40 * 4e-4 + 0.02 * kSlip * kSlip) / 39.02;
  EXPECT_NEAR(errors.passing[0], passing, 1e-12);
  // Their mean is nothing: a 40th of that, and a little less by what was told.
  EXPECT_NEAR(errors.lasting[0], passing / (40 + passing / (kSlip * kSlip)), 1e-12);
}

TEST_F(WheelAccuracyTest, OldGroundIsForgotten) {
  drive(40, 0.02);
  drive(200, 0);
  // Each stretch leaves 40/41 of the old ones: after 200 0.7 % of 40 squares of 2 %, 2.9e-6, beside
  // 1.3e-6 of what was told.
  EXPECT_NEAR(std::sqrt(accuracy_.errors().passing[0]), std::sqrt(4.2e-6), 2e-5);
  EXPECT_LT(std::sqrt(accuracy_.errors().lasting[0]), 0.001);
}

TEST_F(WheelAccuracyTest, CorrectionsAndGapsAreNoErrorsOfWheels) {
  drive(10, 0);
  accuracy_.roll(ahead(0.0625));
  const Pose T_new_old{exp_so3({0, 0, 0.1}), {0.3, 0, 0}};
  T_map_body_ = T_new_old * T_map_body_ * ahead(0.0625);
  accuracy_.correct(T_new_old);
  accuracy_.see(T_map_body_);
  drive(10, 0);
  // Found elsewhere after a gap, and where the wheels said nothing.
  accuracy_.interrupt();
  T_map_body_.translation.x() += 1;
  drive(10, 0);
  accuracy_.roll(std::nullopt);
  T_map_body_.translation.x() += 1;
  drive(10, 0);
  const WheelErrors errors = accuracy_.errors();
  EXPECT_LT(std::sqrt(errors.passing[0]), 0.003);  // by what was told alone
  EXPECT_LT(std::sqrt(errors.lasting[0]), 0.001);
}

}  // namespace
}  // namespace vinebench::slam
