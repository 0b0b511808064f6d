// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/camera/tag_cameras.h"

#include <gtest/gtest.h>

namespace vinebench::slam {
namespace {

TEST(TagCamerasTest, TheUndistortedOnesArePinholesInTheSamePlaces) {
  std::vector<RigCamera> rig(2);
  rig[0] = {"ahead", {640, 480, 400, 410, 320, 240, {}}, {}};
  rig[1] = {"side",
            {1920, 1080, 733, 734, 960, 540, {-0.1, 0.02, 0.001, 0}},
            Rig::mount({0.1, -0.2, 0.5}, {0, 0, -1.5})};
  const TagCameras cameras(rig);
  ASSERT_EQ(cameras.undistorted.size(), 2u);
  EXPECT_EQ(cameras.cameras[1].model.distortion, rig[1].model.distortion);
  const StereoCameraModel& side = cameras.undistorted[1];
  EXPECT_FALSE(side.lens.has_distortion());
  EXPECT_EQ(side.lens.fy, 734);
  EXPECT_EQ(side.baseline, 0);
  // A point a metre ahead of the camera is there again by way of the body.
  const Eigen::Vector3d p_cam(0.1, 0.2, 1);
  EXPECT_LT((side.T_cam_body * (rig[1].T_body_cam * p_cam) - p_cam).norm(), 1e-12);
}

}  // namespace
}  // namespace vinebench::slam
