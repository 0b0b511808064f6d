// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/odometry/preintegrated_motion.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/geometry/pose.h"

namespace vinebench::slam {
namespace {

// 2 m/s^2 for 3 s: 6 m/s, and 9 m from rest.
TEST(PreintegratedMotionTest, AConstantForceIsIntegratedTwice) {
  PreintegratedMotion motion;
  for (int i = 0; i < 30; ++i) motion.add({0, 0, 0}, {2, 0, 0}, {0.1, 0, 0}, 0.1);
  EXPECT_NEAR(motion.seconds, 3, 1e-12);
  EXPECT_NEAR((motion.velocity - Eigen::Vector3d(6, 0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((motion.position - Eigen::Vector3d(9, 0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR(motion.accelerometer_bias.x(), 0.1, 1e-12);
}

// A force to the left of a body that turns by w: a circle. From rest the velocity is
// f / w (cos wt - 1, sin wt), the position f / w^2 (sin wt - wt, 1 - cos wt). Steps of 1 ms, whose
// force is that of their middle, leave (w dt)^2 / 24 of it.
TEST(PreintegratedMotionTest, TheForceTurnsWithTheBody) {
  PreintegratedMotion motion;
  const double w = std::numbers::pi / 2;  // rad/s: a quarter in the second
  for (int i = 0; i < 1000; ++i) motion.add({0, 0, w}, {0, 3, 0}, {0, 0, 0}, 1e-3);
  EXPECT_NEAR(angle_of(motion.turn), w, 1e-9);
  const double v = 3 / w;
  EXPECT_NEAR((motion.velocity - Eigen::Vector3d(-v, v, 0)).norm(), 0, 1e-5);
  EXPECT_NEAR((motion.position - v / w * Eigen::Vector3d(1 - w, 1, 0)).norm(), 0, 1e-5);
}

// Linear in the bias where the turn is known: what is said of it is what a smaller force gives.
TEST(PreintegratedMotionTest, SaysWhatABiasWouldChange) {
  const Eigen::Vector3d turn(0.3, -0.2, 0.9), force(0.5, -0.3, 9.8), bias(0.02, -0.05, 0.03);
  PreintegratedMotion motion, other;
  for (int i = 0; i < 50; ++i) {
    motion.add(turn, force, {0, 0, 0}, 0.01);
    other.add(turn, force - bias, {0, 0, 0}, 0.01);
  }
  EXPECT_NEAR((motion.velocity + motion.velocity_by_bias * bias - other.velocity).norm(), 0, 1e-12);
  EXPECT_NEAR((motion.position + motion.position_by_bias * bias - other.position).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace vinebench::slam
