// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world/occluder_pose.h"

#include <gtest/gtest.h>

#include "sim/world/world.h"
#include "sim/world/world_layout.h"

namespace vinebench::sim {
namespace {

/// 10 % uphill towards x; height 0 in the row's middle, x = 3 m.
Terrain slope() {
  WorldConfig world;
  world.rows = {{{0, 0}, {6, 0}}};
  world.terrain.slope_percent = 10;
  return lay_out(world).terrain;
}

TEST(OccluderPoseTest, ABoxIsSunkUntilNoCornerHangs) {
  Occluder box;
  box.size = {0.4, 0.4, 0.4};
  box.position = {4, 1};
  // Its lowest corner's ground is that of x = 3.8 m.
  EXPECT_NEAR(occluder_pose(box, slope()).translation.z(), 0.08, 1e-9);
  box.lift = 0.5;
  EXPECT_NEAR(occluder_pose(box, slope()).translation.z(), 0.58, 1e-9);
}

TEST(OccluderPoseTest, APersonStandsUprightAndACrateLeans) {
  Occluder occluder;
  occluder.position = {5, 1};
  occluder.shape = Occluder::Shape::kPerson;
  occluder.yaw_deg = 90;
  const Pose person = occluder_pose(occluder, slope());
  EXPECT_NEAR(person.translation.z(), 0.2, 1e-9);  // 2 m uphill of the middle
  EXPECT_LT((person.rotation * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 1e-12);
  EXPECT_LT((person.rotation * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  occluder.shape = Occluder::Shape::kCrate;
  const Eigen::Vector3d up = occluder_pose(occluder, slope()).rotation * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(up.x() / up.z(), -0.1, 1e-9);  // square to the slope
}

// 1 m/s to the west from x = 5 m: after 2 s at x = 3 m, where the ground's height is 0.
TEST(OccluderMotionTest, APersonFollowsTheGroundAndLooksWhereItGoes) {
  Occluder person;
  person.shape = Occluder::Shape::kPerson;
  person.path.emplace();
  person.path->waypoints = {{{5, 1}}, {{1, 1}}};
  const OccluderMotion motion(person, slope());
  EXPECT_LT((motion.at(0).translation - Eigen::Vector3d(5, 1, 0.2)).norm(), 1e-9);
  const Pose later = motion.at(2 * kNanosecondsPerSecond);
  EXPECT_LT((later.translation - Eigen::Vector3d(3, 1, 0)).norm(), 1e-9);
  EXPECT_LT((later.rotation * Eigen::Vector3d::UnitX() + Eigen::Vector3d::UnitX()).norm(), 1e-9);
  EXPECT_EQ(occluder_pose(person, slope()).translation, motion.at(0).translation);
  // Sideways: its own x axis is turned from west to south.
  person.yaw_deg = 90;
  const Pose sideways = OccluderMotion(person, slope()).at(0);
  EXPECT_LT((sideways.rotation * Eigen::Vector3d::UnitX() + Eigen::Vector3d::UnitY()).norm(), 1e-9);
}

}  // namespace
}  // namespace vinebench::sim
