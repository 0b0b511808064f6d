// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/placement/camera_mounts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/config/yaml.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

/// The aisle between two rows along x, from west to east, with one tag to the right of the drive.
class CameraMountsTest : public testing::Test {
 protected:
  PlannedDrive drive() const {
    folder_.write("world.yaml",
                  "rows:\n  - {start: [0, -1.25], end: [10, -1.25]}\n"
                  "  - {start: [0, 1.25], end: [10, 1.25]}\n"
                  "tags: [{id: 0, position: [5, -1.0, 0.5], facing_deg: 90}]\n");
    folder_.write("route.yaml", "name: aisle\nworld: world.yaml\nrover: " VINEBENCH_SOURCE_DIR
                                "/models/csl-rover/rover.yaml\nroute:\n  waypoints:\n"
                                "    - {position: [1, 0]}\n    - {position: [9, 0]}\n");
    return plan_drive(folder_ / "world.yaml", folder_ / "route.yaml", {}, {});
  }
  CameraMount rated(double yaw_deg) const {
    const PlannedDrive planned = drive();
    CameraMount mount = current_mount(rig_, "side");
    mount.rpy_deg.z() = yaw_deg;
    rate_mount(mount, "side", planned);
    return mount;
  }

  test::TestFolder folder_;
  RigConfig rig_ =
      YamlDocument::load(VINEBENCH_SOURCE_DIR "/models/csl-rover/rig.yaml").read<RigConfig>();
};

// A camera that looks to the right sees it as it passes, one that looks to the left never; the
// rig's is mounted to the right.
TEST_F(CameraMountsTest, SeesWhatItIsTurnedTo) {
  const CameraMount right = rated(-90);
  EXPECT_EQ(current_mount(rig_, "side").rpy_deg.z(), -90);
  EXPECT_EQ(right.tags, 1u);
  EXPECT_GE(right.poses, 2u);
  const CameraMount left = rated(90);
  EXPECT_EQ(left.tags, 0u);
  EXPECT_EQ(left.poses, 0u);
  EXPECT_LT(right.error, left.error);
}

TEST_F(CameraMountsTest, TheBestIsFirst) {
  const PlannedDrive planned = drive();
  const auto mounts =
      rate_mounts(current_mount(rig_, "side"), "side", planned, {90, {0}, {0, -0.45}});
  ASSERT_EQ(mounts.size(), 4u);  // none is 5 cm above the ground
  EXPECT_EQ(mounts.front().tags, 1u);
  for (std::size_t i = 1; i < mounts.size(); ++i) {
    EXPECT_LE(mounts[i - 1].error, mounts[i].error);
  }
  const std::string csv = mounts_csv(mounts);
  EXPECT_EQ(std::ranges::count(csv, '\n'), 5);
}

TEST_F(CameraMountsTest, TheRigHasTheNewMountAndElseItsOwn) {
  CameraMount mount = current_mount(rig_, "side");
  mount.rpy_deg.z() = 45;
  const RigConfig changed = with_mount(rig_, "side", mount);
  EXPECT_EQ(changed.cameras[4].rpy_deg.z(), 45);
  EXPECT_EQ(changed.cameras[0].rpy_deg, rig_.cameras[0].rpy_deg);
  EXPECT_THAT(test::error_of([&] { with_mount(rig_, "sid", mount); }),
              testing::HasSubstr("did you mean 'side'"));
}

}  // namespace
}  // namespace vinebench::harness
