// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/rover/wheel_controller.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vinebench::sim {
namespace {

TEST(MecanumDriveTest, BodyMotionInvertsWheelSpeeds) {
  const MecanumDrive drive;
  const Eigen::Vector3d twist(0.3, -0.2, 0.7);
  EXPECT_NEAR((drive.body_motion(drive.wheel_speeds(twist)) - twist).norm(), 0, 1e-12);
  // Forward, all wheels have the same speed: 0.3 m/s at 0.1 m are 3 rad/s.
  EXPECT_THAT(drive.wheel_speeds({0.3, 0, 0}), testing::Each(testing::DoubleEq(3)));
}

TEST(SpeedLoopTest, KeepsItsLimitAndDoesNotWindUp) {
  SpeedLoop loop(SpeedLoopConfig{});
  for (int i = 0; i < 4000; ++i) EXPECT_LE(loop.torque(10, 0, 0.0025), 5);  // a blocked wheel
  // Once the wheel is 1 rad/s too fast the torque changes its sign within 0.2 s.
  double torque = 0;
  for (int i = 0; i < 80; ++i) torque = loop.torque(10, 11, 0.0025);
  EXPECT_LT(torque, 0);
}

// To the left: by the rollers' 45 degrees, front left and rear right turn back.
TEST(MecanumDriveTest, SlidesAndTurnsByTheSignsOfItsWheels) {
  const MecanumDrive drive;
  EXPECT_THAT(drive.wheel_speeds({0, 0.2, 0}),
              testing::Pointwise(testing::DoubleEq(), WheelArray{-2, 2, 2, -2}));
  // 1 rad/s at lever arms of 0.19 + 0.15 m: 0.34 m/s, 3.4 rad/s.
  EXPECT_THAT(drive.wheel_speeds({0, 0, 1}),
              testing::Pointwise(testing::DoubleNear(1e-12), WheelArray{-3.4, 3.4, -3.4, 3.4}));
}

// One wheel alone contributes a quarter: r / 4 forward for one radian.
TEST(MecanumDriveTest, TheTwistOfOneWheelIsTheLeastSquaresOne) {
  const MecanumDrive drive;
  const Eigen::Vector3d motion = drive.body_motion({0, 1, 0, 0});
  EXPECT_NEAR(motion.x(), 0.025, 1e-12);
  EXPECT_NEAR(motion.y(), 0.025, 1e-12);
  EXPECT_NEAR(motion.z(), 0.025 / 0.34, 1e-12);
}

// P of 3 Nm per rad/s, I of 20 Nm per rad over 0.01 s, friction fed forward where it turns.
TEST(SpeedLoopTest, AddsProportionalIntegralAndFriction) {
  SpeedLoop loop(SpeedLoopConfig{});
  EXPECT_NEAR(loop.torque(1, 0.5, 0.01), 3 * 0.5 + 0.1, 1e-9);
  EXPECT_NEAR(loop.torque(1, 0.5, 0.01), 3 * 0.5 + 0.1 + 20 * 0.5 * 0.01, 1e-9);
}

}  // namespace
}  // namespace vinebench::sim
