// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/odometry/wheel_drift.h"

#include <gtest/gtest.h>

namespace vinebench::slam {
namespace {

const Pose kAhead{Eigen::Quaterniond::Identity(), {0.0625, 0, 0}};  // four are a stretch

/// Variances: of the rates along x and about z.
Vector6d rates(double slip, double heading) {
  Vector6d variances = Vector6d::Zero();
  variances[0] = slip * slip;
  variances[5] = heading * heading;
  return variances;
}

TEST(WheelDriftTest, WhatLastsGrowsWithTheWay) {
  const WheelErrors errors{rates(0.01, 0.01), Vector6d::Zero()};
  WheelDrift drift;
  for (int i = 0; i < 64; ++i) drift.roll(kAhead, errors);
  const Matrix6d P = drift.covariance(errors);
  // 4 m: 1 % is 4 cm, 0.01 rad a metre is 0.04 rad. That turns what is left of the way at each of
  // 64 steps: 0.01 * 0.0625^2 * (0 + ... + 63) = 0.07875 m to the side.
  EXPECT_NEAR(std::sqrt(P(0, 0)), 0.04, 1e-12);
  EXPECT_NEAR(std::sqrt(P(5, 5)), 0.04, 1e-12);
  EXPECT_NEAR(std::sqrt(P(1, 1)), 0.07875, 1e-12);
  EXPECT_NEAR(P(1, 5), 0.07875 * 0.04, 1e-12);  // the same error is in both
  EXPECT_EQ(P(2, 2), 0);
}

TEST(WheelDriftTest, WhatPassesGrowsWithItsRoot) {
  const WheelErrors errors{Vector6d::Zero(), rates(0.01, 0.01)};
  WheelDrift drift;
  for (int i = 0; i < 64; ++i) drift.roll(kAhead, errors);
  // 16 stretches of 2.5 mm and 2.5 mrad each: four times as much.
  EXPECT_NEAR(std::sqrt(drift.covariance(errors)(0, 0)), 0.01, 1e-12);
  EXPECT_NEAR(std::sqrt(drift.covariance(errors)(5, 5)), 0.01, 1e-12);
  // Half a stretch more has half of 2.5 mm.
  drift.roll(kAhead, errors);
  drift.roll(kAhead, errors);
  EXPECT_NEAR(drift.covariance(errors)(0, 0), 1e-4 + 1.25e-3 * 1.25e-3, 1e-12);
}

// Against the difference that a small rate makes of a way with turns in all axes.
TEST(WheelDriftTest, ARateMovesTheEndOfAWay) {
  constexpr double kSmall = 1e-6;
  for (int axis = 0; axis < 6; ++axis) {
    WheelWay way, off;
    for (int i = 0; i < 20; ++i) {
      const Pose step{exp_so3({0.01, -0.02, 0.05 * (i % 3)}), {0.1, 0.02, -0.01}};
      const double length = step.translation.norm() + angle_of(step.rotation);
      Vector6d wrong = Vector6d::Zero();
      wrong[axis] = kSmall * length;
      way.roll(step);
      off.roll(step * step_of(wrong));
    }
    const Pose moved = way.T_start_now.inverse() * off.T_start_now;
    Vector6d by;
    by << moved.translation, log_so3(moved.rotation);
    // The rate itself makes the steps longer, by 1e-6 of the way's 5 m and rad.
    EXPECT_LT((by / kSmall - way.by_rate.col(axis)).norm(), 1e-4) << axis;
  }
}

}  // namespace
}  // namespace vinebench::slam
