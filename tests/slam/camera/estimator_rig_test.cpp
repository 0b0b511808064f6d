// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/camera/estimator_rig.h"

#include <gtest/gtest.h>

namespace vinebench::slam {
namespace {

TEST(EstimatorRigTest, TagCamerasHaveNoDistortionLeft) {
  Rig bent = load_rig(VINEBENCH_SOURCE_DIR "/models/csl-rover/rig.yaml");
  bent.cameras[4].model.distortion = {-0.05, 0, 0, 0};
  const EstimatorRig rig(make_stereo_rig(bent, {}), OrbConfig{});
  ASSERT_EQ(rig.tag_cameras.undistorted.size(), 5u);
  EXPECT_FALSE(rig.tag_cameras.undistorted[4].lens.has_distortion());
  EXPECT_EQ(rig.tag_cameras.undistorted[4].lens.fx, 733);
  const Pose identity = rig.tag_cameras.undistorted[4].T_cam_body * bent.cameras[4].T_body_cam;
  EXPECT_LT((identity.matrix() - Eigen::Matrix4d::Identity()).norm(), 1e-14);
}

TEST(EstimatorRigTest, OffsetsMakeAnotherRig) {
  const EstimatorRig rig(
      make_stereo_rig(load_rig(VINEBENCH_SOURCE_DIR "/models/csl-rover/rig.yaml"), {}),
      OrbConfig{});
  const EstimatorRig corrected = rig.with_disparity_offsets({0.5, -0.25});
  EXPECT_EQ(corrected.left_cameras[0].disparity_offset, 0.5);
  EXPECT_EQ(corrected.left_cameras[1].disparity_offset, -0.25);
  EXPECT_EQ(rig.left_cameras[0].disparity_offset, 0);
}

}  // namespace
}  // namespace vinebench::slam
