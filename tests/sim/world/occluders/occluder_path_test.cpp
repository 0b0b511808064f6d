// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world/occluders/occluder_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/config/validate.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using testing::HasSubstr;

constexpr double kQuarter = std::numbers::pi / 2;

OccluderPath path_of(std::vector<OccluderPath::Waypoint> waypoints) {
  OccluderPath path;
  path.waypoints = std::move(waypoints);
  return path;
}

/// Stamps are whole nanoseconds, and no speed here is above 2 m/s or half a turn a second.
void expect_place(const PathMotion& motion, double seconds, const Eigen::Vector3d& expected) {
  const Eigen::Vector3d found = motion.at(from_seconds(seconds));
  EXPECT_LT((found.head<2>() - expected.head<2>()).norm(), 1e-8) << seconds;
  EXPECT_NEAR(std::remainder(found.z() - expected.z(), 4 * kQuarter), 0, 1e-8) << seconds;
}

TEST(PathMotionTest, GoesStraightAtItsSpeedAndStaysAtItsEnd) {
  OccluderPath path = path_of({{{1, 2}}, {{5, 2}}});
  path.speed = 2;
  const PathMotion motion(path);
  expect_place(motion, -1, {1, 2, 0});
  expect_place(motion, 0, {1, 2, 0});
  expect_place(motion, 0.5, {2, 2, 0});
  expect_place(motion, 2, {5, 2, 0});
  expect_place(motion, 100, {5, 2, 0});
  EXPECT_EQ(motion.duration(), 2 * kNanosecondsPerSecond);
}

TEST(PathMotionTest, TurnsOnTheSpotTheShorterWay) {
  OccluderPath path = path_of({{{0, 0}}, {{1, 0}}, {{1, -1}}});
  path.turn_rate_deg = 90;
  const PathMotion motion(path);
  expect_place(motion, 1.5, {1, 0, -kQuarter / 2});
  expect_place(motion, 2.25, {1, -0.25, -kQuarter});
}

TEST(PathMotionTest, WaitsAndHasSpeedsOfItsLegs) {
  const PathMotion motion(path_of({{{0, 0}, {}, 0.5}, {{2, 0}, 0.5, 1}, {{3, 0}}}));
  expect_place(motion, 0.5, {0, 0, 0});
  expect_place(motion, 2.5, {1, 0, 0});  // 2 s of the first leg at 0.5 m/s
  expect_place(motion, 5.5, {2, 0, 0});  // it arrived at 4.5 s
  expect_place(motion, 5.75, {2.25, 0, 0});
}

TEST(PathMotionTest, ALoopGoesBackToItsBeginAndAgain) {
  OccluderPath path = path_of({{{0, 0}}, {{2, 0}}});
  path.loop = true;
  const PathMotion motion(path);
  // 2 s there, 1 s for half a turn, 2 s back, 1 s to turn again.
  EXPECT_EQ(motion.duration(), 6 * kNanosecondsPerSecond);
  expect_place(motion, 4, {1, 0, 2 * kQuarter});
  expect_place(motion, 6, {0, 0, 0});
  expect_place(motion, 6.5, {0.5, 0, 0});
  expect_place(motion, 6 * 1000 + 4, {1, 0, 2 * kQuarter});
}

TEST(PathMotionTest, ALoopMayEndAtItsBegin) {
  OccluderPath path = path_of({{{0, 0}}, {{2, 0}}, {{0, 0}}});
  path.loop = true;
  EXPECT_EQ(PathMotion(path).duration(), 6 * kNanosecondsPerSecond);
}

TEST(OccluderPathTest, ProblemsAreNamed) {
  const auto problem = [](const OccluderPath& path) {
    return test::error_of([&] { validate(path); });
  };
  EXPECT_THAT(problem(path_of({{{1, 2}}})), HasSubstr("expected at least two waypoints"));
  EXPECT_THAT(problem(path_of({{{1, 2}}, {{1, 2}}})), HasSubstr("1 cm or more apart"));
  EXPECT_THAT(problem(path_of({{{1, 2}}, {{3, 2}, 0.0}})), HasSubstr("speed"));
  EXPECT_EQ(problem(path_of({{{1, 2}}, {{3, 2}}})), "");
}

}  // namespace
}  // namespace vinebench::sim
