// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/benchmarks/render_case.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vinebench::harness {
namespace {

/// Of the x axis, rad.
double heading_of(const Pose& pose) {
  const Eigen::Vector3d x = pose.rotation * Eigen::Vector3d::UnitX();
  return std::atan2(x.y(), x.x());
}

void expect_pose(const Pose& pose, const Eigen::Vector3d& at, double yaw) {
  EXPECT_LT((pose.translation - at).norm(), 1e-9) << pose.translation.transpose();
  EXPECT_NEAR(std::remainder(heading_of(pose) - yaw, 2 * std::numbers::pi), 0, 1e-9);
}

TEST(AisleRouteTest, DrivesTheMiddleAisleLookingAheadAndBackByTurns) {
  // Three rows: the aisle of rows 0 and 1. Two poses at a quarter and three quarters of 4 m.
  sim::WorldConfig world;
  world.rows = {{{0, -1}, {4, -1}}, {{0, 1}, {4, 1}}, {{0, 3}, {4, 3}}};
  const std::vector<Pose> route = aisle_route(world, 2);
  ASSERT_EQ(route.size(), 2u);
  expect_pose(route[0], {1, 0, 0}, 0);
  expect_pose(route[1], {3, 0, 0}, std::numbers::pi);
}

TEST(AisleRouteTest, ExpandsABlock) {
  // Rows to the north at x = 0, -2, -4, -6 (each to the left of the previous one): the middle aisle
  // is at x = -3.
  sim::WorldConfig world;
  world.block = sim::WorldConfig::Block{4, 10, 2, 90, {0, 0}};
  expect_pose(aisle_route(world, 1).at(0), {-3, 5, 0}, std::numbers::pi / 2);
}

TEST(AisleRouteTest, RowsMayRunAgainstEachOther) {
  sim::WorldConfig world;
  world.rows = {{{4, -1}, {0, -1}}, {{0, 1}, {4, 1}}};
  expect_pose(aisle_route(world, 1).at(0), {2, 0, 0}, 0);
}

TEST(AisleRouteTest, StaysBesideALoneRow) {
  sim::WorldConfig world;
  world.rows = {{{0, 0}, {4, 0}}};
  expect_pose(aisle_route(world, 1).at(0), {2, -1, 0}, 0);
}

TEST(AisleRouteTest, LiesOnTheGround) {
  // A slope of 10 % up along the rows, level at the rows' middle: 0.1 m per metre.
  sim::WorldConfig world;
  world.rows = {{{0, -1}, {4, -1}}, {{0, 1}, {4, 1}}};
  world.terrain.slope_percent = 10;
  const std::vector<Pose> route = aisle_route(world, 2);
  EXPECT_NEAR(route[0].translation.z(), -0.1, 1e-9);
  EXPECT_NEAR(route[1].translation.z(), 0.1, 1e-9);
  EXPECT_NEAR((route[0].rotation * Eigen::Vector3d::UnitX()).z(), std::sin(std::atan(0.1)), 1e-9);
}

}  // namespace
}  // namespace vinebench::harness
