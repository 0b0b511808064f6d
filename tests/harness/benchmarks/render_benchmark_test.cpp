// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/benchmarks/render_benchmark.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <numbers>

#include "core/util/error.h"
#include "harness/benchmarks/measurement.h"
#include "harness/benchmarks/render_report.h"

namespace vinebench::harness {
namespace {

using testing::HasSubstr;

/// Of the x axis, rad.
double yaw_of(const Pose& pose) {
  const Eigen::Vector3d x = pose.rotation * Eigen::Vector3d::UnitX();
  return std::atan2(x.y(), x.x());
}

void expect_pose(const Pose& pose, const Eigen::Vector3d& at, double yaw) {
  EXPECT_LT((pose.translation - at).norm(), 1e-9) << pose.translation.transpose();
  EXPECT_NEAR(std::remainder(yaw_of(pose) - yaw, 2 * std::numbers::pi), 0, 1e-9);
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
  world.place();
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

TEST(MedianTest, IsTheMiddleValueAndOfTwoTheUpper) {
  EXPECT_EQ(median(std::vector<double>{5, 1, 9}), 5);
  EXPECT_EQ(median(std::vector<double>{3, 1, 4, 2}), 3);
  EXPECT_THROW(median(std::vector<double>{}), Error);
  const Timing timing = median(std::vector<Timing>{{1, 30}, {2, 20}, {3, 10}});
  EXPECT_EQ(timing.cpu_ms, 2);
  EXPECT_EQ(timing.wall_ms, 20);
}

TEST(MeasureTest, CountsTheTimeOfTheWork) {
  volatile double sum = 0;
  const Timing timing = measure([&] {
    for (int i = 0; i < 1'000'000; ++i) sum = sum + 1;
  });
  // A million dependent additions through memory take at least a cycle each: 0.1 ms at 10 GHz.
  EXPECT_GT(timing.cpu_ms, 0.1);
  EXPECT_GT(timing.wall_ms, 0.1);
}

TEST(RenderTableTest, NamesEveryFigure) {
  const auto world = nlohmann::ordered_json::parse(R"({
    "name": "small", "rows": 3, "plants": 12,
    "cameras": [{"camera": "side", "pixels": "64 x 48", "cpu_ms": 12.34, "wall_ms": 11.1}],
    "frame_wall_ms": {"1": 80.0, "2": 40.0}, "scaling": 2.0,
    "memory_mib": 321, "build_s": 1.5, "upload_s": 0.5,
    "mujoco": {"platform": "EGL", "images": [{"camera": "side", "pixels": "64 x 48",
      "meshes": "finest", "shadows": false, "triangles": 1000, "cpu_ms": 123.4,
      "wall_ms": 100.0, "throughput_ratio": 10.0}]}})");
  const std::string table = render_table(world);
  EXPECT_THAT(table, HasSubstr("small: 3 rows, 12 plants\n"));
  EXPECT_THAT(table, HasSubstr("side               64 x 48      12.3      11.1\n"));
  EXPECT_THAT(table, HasSubstr("80.0 ms wall with 1 thread, 40.0 ms wall with 2 threads, x 2.00"));
  EXPECT_THAT(table, HasSubstr("321 MiB"));
  EXPECT_THAT(table, HasSubstr("123.4     100.0    finest       no       1000     10.0\n"));
}

}  // namespace
}  // namespace vinebench::harness
