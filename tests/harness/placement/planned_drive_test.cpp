// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/placement/planned_drive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

TEST(PlannedDriveTest, TheRouteInAnotherWorld) {
  const test::TestFolder folder;
  folder.write("world.yaml",
               "name: another\nrows: [{start: [0, -1.25], end: [9, -1.25]}]\n"
               "trellis: {post_spacing: 3}\n");
  const PlannedDrive drive = plan_drive(
      folder / "world.yaml", VINEBENCH_SOURCE_DIR "/scenarios/aisle-loop.yaml", {}, {0.01, 0});
  EXPECT_EQ(drive.world().name, "another");
  EXPECT_EQ(drive.poses.size(), drive.chain.size());
  EXPECT_EQ(drive.sightings.survey.position, 0.01);
  EXPECT_TRUE(own_tags(drive).empty());
  EXPECT_EQ(post_candidates(drive, 0.5, 0.161).size(), 8u);  // four posts, two sides
}

TEST(PlannedDriveTest, NeedsACameraForTags) {
  const test::TestFolder folder;
  folder.write("world.yaml", "rows: [{start: [0, -1.25], end: [9, -1.25]}]\n");
  folder.write("route.yaml",
               "name: blind\nworld: world.yaml\n"
               "rover: {model: " VINEBENCH_SOURCE_DIR
               "/models/csl-rover/rover.xml, rig: " VINEBENCH_SOURCE_DIR
               "/tests/planted_causes/rig.yaml}\n"
               "route: {waypoints: [{position: [0, 0]}, {position: [1, 0]}]}\n");
  EXPECT_THAT(
      test::error_of([&] { plan_drive(folder / "world.yaml", folder / "route.yaml", {}, {}); }),
      testing::HasSubstr("route.yaml: the rover has no camera for tags"));
}

}  // namespace
}  // namespace vinebench::harness
