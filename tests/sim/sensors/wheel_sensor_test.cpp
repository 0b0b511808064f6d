// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/wheel_sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vinebench::sim {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

TEST(WheelSensorTest, AnglesAreWholeCounts) {
  WheelSensor sensor({64});
  for (int i = 1; i < 200; ++i) {
    WheelSample sample;
    sample.stamp = i * kNanosecondsPerSecond / 100;
    const std::array<double, 4> truth{0.013 * i, -0.02 * i, 1.0, 0};
    sample.angle = truth;
    sensor.measure(sample);
    for (std::size_t wheel = 0; wheel < 4; ++wheel) {
      const double counts = sample.angle[wheel] / (kTurn / 64);
      EXPECT_NEAR(counts, std::round(counts), 1e-9);
      EXPECT_LE(std::abs(sample.angle[wheel] - truth[wheel]), 0.5 * kTurn / 64 + 1e-12);
    }
  }
}

TEST(WheelSensorTest, SpeedIsCountsInTime) {
  WheelSensor sensor({100});
  WheelSample first, second;
  first.stamp = kNanosecondsPerSecond / 100;
  second.stamp = 2 * first.stamp;
  second.angle = {3.2 * kTurn / 100, -1.7 * kTurn / 100, 0.4 * kTurn / 100, 0};
  second.velocity = {1, 2, 3, 4};
  sensor.measure(first);
  sensor.measure(second);
  // 3, -2, 0 and 0 counts of 1/100 turn in 1/100 s: turns a second.
  EXPECT_NEAR(second.velocity[0], 3 * kTurn, 1e-9);
  EXPECT_NEAR(second.velocity[1], -2 * kTurn, 1e-9);
  EXPECT_EQ(second.velocity[2], 0);
  EXPECT_EQ(second.velocity[3], 0);
}

TEST(WheelSensorTest, ZeroCountsReadTheTruth) {
  WheelSensor sensor({0});
  WheelSample sample;
  sample.stamp = 10;
  sample.angle = {0.1234567, 2, 3, 4};
  sample.velocity = {5, 6, 7, 8};
  const WheelSample before = sample;
  sensor.measure(sample);
  EXPECT_EQ(sample.angle, before.angle);
  EXPECT_EQ(sample.velocity, before.velocity);
}

}  // namespace
}  // namespace vinebench::sim
