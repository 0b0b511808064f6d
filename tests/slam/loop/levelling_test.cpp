// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/loop/levelling.h"

#include <gtest/gtest.h>

namespace vinebench::slam {
namespace {

constexpr double kG = 9.8;  // m/s^2
const Eigen::Vector3d kDown(0, 0, -1);

/// In a map that leans by `lean`, known to `sigma` m/s^2 in each axis.
MapGravity felt(const Eigen::Vector3d& lean, double sigma) {
  MapGravity gravity{exp_so3(lean) * (kG * kDown)};
  gravity.covariance = sigma * sigma * Matrix6d::Identity();
  return gravity;
}

Eigen::Matrix3d isotropic(double sigma) {
  return sigma * sigma * Eigen::Matrix3d::Identity();
}

TEST(LevellingTurnTest, GravityThatIsKnownExactlyIsMadeToPointDown) {
  const Eigen::Vector3d lean(0.01, -0.02, 0);
  const auto turn = levelling_turn(felt(lean, 1e-9), kDown, isotropic(0.02));
  ASSERT_TRUE(turn);
  EXPECT_LT((log_so3(*turn) + lean).norm(), 1e-9);
}

// Both are as sure: 0.098 m/s^2 of 9.8 is 0.01 rad. Half way, and nothing about the vertical.
TEST(LevellingTurnTest, WhatIsAsSureIsMetHalfWay) {
  const Eigen::Vector3d lean(0.01, 0.004, 0);
  const auto turn = levelling_turn(felt(lean, 0.01 * kG), kDown, isotropic(0.01));
  ASSERT_TRUE(turn);
  // To second order of the lean: 1e-4.
  EXPECT_LT((log_so3(*turn) + lean / 2).norm(), 1e-6);
  EXPECT_NEAR(log_so3(*turn).z(), 0, 1e-12);
}

// Along x the map's lean is known exactly, along y not at all.
TEST(LevellingTurnTest, EachAxisIsWeighedByItself) {
  Eigen::Matrix3d known = Eigen::Matrix3d::Zero();
  known(1, 1) = 1;
  const auto turn = levelling_turn(felt({0.01, 0.02, 0}, 0.01 * kG), kDown, known);
  ASSERT_TRUE(turn);
  EXPECT_NEAR(log_so3(*turn).x(), 0, 1e-4);
  EXPECT_NEAR(log_so3(*turn).y(), -0.02, 1e-4);
}

// With two degrees of freedom 99.9 % lie within 3.72 standard deviations.
TEST(LevellingTurnTest, WhatCannotBothBeTrueIsLeft) {
  EXPECT_TRUE(levelling_turn(felt({0.036, 0, 0}, 1e-9), kDown, isotropic(0.01)));
  EXPECT_FALSE(levelling_turn(felt({0.038, 0, 0}, 1e-9), kDown, isotropic(0.01)));
}

}  // namespace
}  // namespace vinebench::slam
