// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/util/error.h"
#include "sim/rover/route.h"
#include "sim/rover/rover.h"
#include "tests/support/csl_rover.h"

namespace vinebench::sim {
namespace {

TEST(RoverObstaclesTest, ABoxIsInTheWay) {
  WorldConfig world = test::field();
  world.occluders.resize(1);
  world.occluders[0].size = {0.4, 0.6, 0.6};
  world.occluders[0].position = {1, 0};
  Rover rover(test::csl_rover(), world, {0, 0, 0}, 1);
  std::vector<ImuSample> imu;
  std::vector<WheelSample> wheels;
  rover.command({0.3, 0, 0});
  rover.advance_to(4 * kNanosecondsPerSecond, imu, wheels);
  // Free, it would be at 1.2 m; the box begins at 0.8 m and the rover is 0.25 m long ahead.
  EXPECT_GT(test::position_of(rover).x(), 0.5);
  EXPECT_LT(test::position_of(rover).x(), 0.57);
}

TEST(RoverObstaclesTest, APostIsInTheWay) {
  WorldConfig world;
  world.rows = {{{1, 0}, {5, 0}}};
  Rover rover(test::csl_rover(), world, {0, 0, 0}, 1);
  std::vector<ImuSample> imu;
  std::vector<WheelSample> wheels;
  rover.command({0.3, 0, 0});
  rover.advance_to(4 * kNanosecondsPerSecond, imu, wheels);
  // The post's face is at 1 m - 0.035 m.
  EXPECT_GT(test::position_of(rover).x(), 0.67);
  EXPECT_LT(test::position_of(rover).x(), 0.73);
}

TEST(RoverObstaclesTest, TurnsRoundInAnAisle) {
  // Two rows 0.8 m apart, a post on either side: 0.365 m clearance each.
  WorldConfig world;
  world.rows = {{{0, -0.4}, {4, -0.4}}, {{0, 0.4}, {4, 0.4}}};
  Rover rover(test::csl_rover(), world, {2, 0, 0}, 1);
  std::vector<ImuSample> imu;
  std::vector<WheelSample> wheels;
  rover.command({0, 0, 0.8});
  rover.advance_to(4 * kNanosecondsPerSecond, imu, wheels);
  EXPECT_NEAR(imu.size(), 800, 0);
  double turned = 0;
  for (const ImuSample& sample : imu) turned += sample.angular_velocity.z() / 200;
  EXPECT_NEAR(turned, 3.2, 0.1);  // not blocked
  EXPECT_LT((test::position_of(rover) - Eigen::Vector2d(2, 0)).norm(), 0.01);
}

TEST(RoverObstaclesTest, ManyObstaclesDoNotExhaustContacts) {
  WorldConfig world;
  for (int i = 0; i < 20; ++i) world.rows.push_back({{-20, 1.0 + i}, {20, 1.0 + i}});
  Rover rover(test::csl_rover(), world, {0, 0, 0}, 1);
  std::vector<ImuSample> imu;
  std::vector<WheelSample> wheels;
  EXPECT_NO_THROW(rover.advance_to(kNanosecondsPerSecond / 2, imu, wheels));
}

}  // namespace
}  // namespace vinebench::sim
