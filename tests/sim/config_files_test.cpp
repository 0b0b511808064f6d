// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/config_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using test::error_of;
using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kWorld = "name: small\nblock: {rows: 2, length: 10, spacing: 2}\n";

TEST(ConfigFilesTest, AWorldIsReadAsItIsWritten) {
  const test::TestFolder folder;
  const WorldConfig world = load_world(folder.write("world.yaml", kWorld));
  EXPECT_EQ(world.name, "small");
  ASSERT_TRUE(world.block);
  EXPECT_EQ(world.block->rows, 2);
  EXPECT_TRUE(world.rows.empty());  // those of the block are the layout's
}

TEST(ConfigFilesTest, OverridesWinOverTheFile) {
  const test::TestFolder folder;
  const auto file = folder.write("world.yaml", kWorld);
  const WorldConfig world =
      load_world(file, {{"name", "other"}, {"block.rows", "3"}, {"sun.elevation_deg", "12.5"}});
  EXPECT_EQ(world.name, "other");
  EXPECT_EQ(world.block->rows, 3);
  EXPECT_EQ(world.sun.elevation_deg, 12.5);
  EXPECT_THAT(error_of([&] {
                load_world(file, {{"sun.colour", "red"}});
              }),
              HasSubstr("sun.colour"));
}

TEST(ConfigFilesTest, EveryViolationOfAWorldIsListed) {
  const test::TestFolder folder;
  const auto file = folder.write("world.yaml", "ground_size: -3\nvines: {spacing: -1}\n");
  EXPECT_THAT(error_of([&] { load_world(file); }),
              AllOf(HasSubstr(file.string() + ":1"), HasSubstr("ground_size"),
                    HasSubstr("vines.spacing"), HasSubstr("expected at least one row")));
}

TEST(ConfigFilesTest, ARoversFilesLieBesideItsOwn) {
  const test::TestFolder folder;
  folder.write("rover.xml", "<mujoco/>");
  folder.write("rig.yaml", "name: none\n");
  const auto file =
      folder.write("rover.yaml", "model: rover.xml\nrig: rig.yaml\nhalf_track: 0.4\n");
  const RoverConfig rover = load_rover(file);
  EXPECT_EQ(rover.model, folder / "rover.xml");
  EXPECT_EQ(rover.rig, folder / "rig.yaml");
  EXPECT_EQ(rover.half_track, 0.4);
  EXPECT_EQ(rover.wheel_radius, RoverConfig{}.wheel_radius);
}

TEST(ConfigFilesTest, EveryViolationOfARoverIsListed) {
  const test::TestFolder folder;
  const auto file = folder.write("rover.yaml", "wheel_radius: 0\nwheels: 4\nmax_torque: -1\n");
  EXPECT_THAT(error_of([&] { load_rover(file); }),
              AllOf(HasSubstr("rover.yaml:1"), HasSubstr("wheel_radius"), HasSubstr("wheels"),
                    HasSubstr("max_torque")));
}

}  // namespace
}  // namespace vinebench::sim
