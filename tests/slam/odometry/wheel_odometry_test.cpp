// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/odometry/wheel_odometry.h"

#include <gtest/gtest.h>

namespace vinebench::slam {
namespace {

WheelSample reading(std::array<double, 4> angle, Stamp stamp = 0) {
  WheelSample sample;
  sample.stamp = stamp;
  sample.angle = angle;
  return sample;
}

TEST(WheelOdometryTest, TellsForwardSidewaysAndTurning) {
  const MecanumWheels wheels{0.1, 0.2, 0.15};
  const auto step = [&](std::array<double, 4> angle) {
    WheelOdometry odometry(wheels);
    EXPECT_FALSE(odometry.step({reading({})}));  // the first has no predecessor
    return odometry.step({reading(angle)})->T_before_now;
  };
  // All wheels by 2 rad at 0.1 m: 0.2 m forward.
  EXPECT_LT((step({2, 2, 2, 2}).translation - Eigen::Vector3d(0.2, 0, 0)).norm(), 1e-12);
  // For motion to the left the front left and rear right wheels turn backwards.
  EXPECT_LT((step({-2, 2, 2, -2}).translation - Eigen::Vector3d(0, 0.2, 0)).norm(), 1e-12);
  // Turning left by a: each wheel rolls a (0.2 + 0.15) m; 0.7 rad of angle is 0.07 m: a = 0.2 rad.
  const Pose turned = step({-0.7, 0.7, -0.7, 0.7});
  EXPECT_NEAR(log_so3(turned.rotation).z(), 0.2, 1e-12);
  EXPECT_LT(turned.translation.norm(), 1e-12);
}

TEST(WheelOdometryTest, ChainsReadingsIntoAnArc) {
  const MecanumWheels wheels{0.1, 0.2, 0.15};
  WheelOdometry odometry(wheels);
  odometry.step({reading({})});
  std::vector<WheelSample> readings;
  // A quarter circle of radius 1 m: 100 steps of pi / 200 rad and as many metres.
  const double part = 3.14159265358979 / 200;
  for (int i = 1; i <= 100; ++i) {
    const double ahead = part * i / 0.1;
    const double turn = part * i * 0.35 / 0.1;
    readings.push_back(reading({ahead - turn, ahead + turn, ahead - turn, ahead + turn},
                               i * kNanosecondsPerSecond / 50));
  }
  const auto step = odometry.step(readings);
  EXPECT_NEAR(step->seconds, 2, 1e-9);
  const Pose& arc = step->T_before_now;
  EXPECT_NEAR(log_so3(arc.rotation).z(), 3.14159265358979 / 2, 1e-9);
  // Chords instead of arcs: part^2 / 24 = 1e-5 of the path too long.
  EXPECT_LT((arc.translation - Eigen::Vector3d(1, 1, 0)).norm(), 3e-5);
  EXPECT_FALSE(odometry.step({}));
}

}  // namespace
}  // namespace vinebench::slam
