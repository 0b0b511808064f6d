// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/explain/rolling_wheels.h"

#include <gtest/gtest.h>

namespace vinebench::harness {
namespace {

const sim::MecanumDrive kDrive{.wheel_radius = 0.1, .half_track = 0.2, .half_wheelbase = 0.1};

WheelSample reading(double seconds, double angle) {
  WheelSample sample;
  sample.stamp = from_seconds(seconds);
  sample.angle.fill(angle);
  return sample;
}

StampedPose pose(double seconds, double x, double yaw = 0) {
  return {from_seconds(seconds), {from_roll_pitch_yaw({0, 0, yaw}), {x, 0, 0}}};
}

// 0.5 m/s on wheels of 0.1 m are 5 rad/s: 0.05 rad in 10 ms, whatever the encoders read.
TEST(RollingWheelsTest, TurnAsFarAsTheRoverMoves) {
  RollingWheels wheels(kDrive);
  std::vector<WheelSample> readings{reading(1.00, 7), reading(1.01, 8), reading(1.02, 9)};
  wheels.replace(readings, {pose(0.99, 0.495), pose(1.02, 0.51)});
  EXPECT_EQ(readings[0].angle[0], 7);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(readings[1].angle[i], 7.05, 1e-9);
    EXPECT_NEAR(readings[2].angle[i], 7.10, 1e-9);
    EXPECT_NEAR(readings[2].velocity[i], 5, 1e-7);
  }
  std::vector<WheelSample> later{reading(1.03, 100)};
  wheels.replace(later, {pose(1.03, 0.515)});
  EXPECT_NEAR(later[0].angle[3], 7.15, 1e-9);
}

// 0.01 rad to the left on the spot: the wheels of either side turn by 0.3 m / 0.1 m times that.
TEST(RollingWheelsTest, TurnOnTheSpot) {
  RollingWheels wheels(kDrive);
  std::vector<WheelSample> readings{reading(0, 0), reading(0.01, 1)};
  wheels.replace(readings, {pose(0, 0), pose(0.01, 0, 0.01)});
  EXPECT_NEAR(readings[1].angle[0], -0.03, 1e-9);
  EXPECT_NEAR(readings[1].angle[1], 0.03, 1e-9);
}

TEST(RollingWheelsTest, WithoutAPathReadingsStay) {
  RollingWheels wheels(kDrive);
  std::vector<WheelSample> readings{reading(0, 0), reading(0.01, 1)};
  wheels.replace(readings, {});
  EXPECT_EQ(readings[1].angle[0], 1);
}

}  // namespace
}  // namespace vinebench::harness
