// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/format/rectified.h"

#include <gtest/gtest.h>

namespace vinebench::harness {
namespace {

/// Ideal cameras 0.1 m apart along the left one's x axis.
class RectifiedTest : public testing::Test {
 protected:
  RectifiedTest() {
    RigCamera left;
    left.model = {.width = 8, .height = 6, .fx = 5, .fy = 5, .cx = 3.5, .cy = 2.5};
    RigCamera right = left;
    right.T_body_cam.translation.x() = 0.1;
    rig_.cameras = {left, right};
  }
  bool rectified() const { return is_rectified(rig_, {"front", 0, 1}); }
  RigCamera& right() { return rig_.cameras[1]; }
  Rig rig_;
};

TEST_F(RectifiedTest, OnlyTheXOfThePrincipalPointMayDiffer) {
  EXPECT_TRUE(rectified());
  right().model.cx = 4;
  EXPECT_TRUE(rectified());
  right().model.cy = 2.6;
  EXPECT_FALSE(rectified());
  right().model.cy = 2.5;
  right().model.fx = 5.1;
  EXPECT_FALSE(rectified());
}

TEST_F(RectifiedTest, DistortionIsNone) {
  right().model.distortion[0] = 1e-3;
  EXPECT_FALSE(rectified());
}

TEST_F(RectifiedTest, AxesAreParallelAndTheRightOneIsToTheRight) {
  right().T_body_cam.rotation = from_roll_pitch_yaw({0, 0, 1e-5});  // 1e-6 rad is what may be
  EXPECT_FALSE(rectified());
  right().T_body_cam.rotation.setIdentity();
  right().T_body_cam.translation.y() = 1e-6;  // of 0.1 m: 1e-5 rad
  EXPECT_FALSE(rectified());
  right().T_body_cam.translation = {-0.1, 0, 0};
  EXPECT_FALSE(rectified());
}

}  // namespace
}  // namespace vinebench::harness
