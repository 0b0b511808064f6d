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

TEST(EstimatorRigTest, ACalibrationMakesAnotherRig) {
  const EstimatorRig rig(
      make_stereo_rig(load_rig(VINEBENCH_SOURCE_DIR "/models/csl-rover/rig.yaml"), {}),
      OrbConfig{});
  // The second camera is a centimetre further along its own axis.
  const Pose ahead{Eigen::Quaterniond::Identity(), {0, 0, 0.01}};
  const EstimatorRig corrected = rig.with_calibration({{{{}, 0.5}, {ahead, -0.25}}, {0.002}});
  EXPECT_EQ(corrected.left_cameras[0].disparity_offset, 0.5);
  EXPECT_EQ(corrected.left_cameras[1].disparity_offset, -0.25);
  EXPECT_EQ(rig.left_cameras[0].disparity_offset, 0);
  ASSERT_EQ(rig.rig.tag_cameras, std::vector<int>{4});
  EXPECT_EQ(rig.tag_time(4), 0);
  EXPECT_EQ(corrected.tag_time(4), 0.002);
  const Eigen::Vector3d optical_axis = rig.T_body_cams[1].rotation * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d moved = rig.T_body_cams[1].translation + 0.01 * optical_axis;
  EXPECT_LT((corrected.T_body_cams[1].translation - moved).norm(), 1e-15);
  const Pose identity = corrected.left_cameras[1].T_cam_body * corrected.T_body_cams[1];
  EXPECT_LT((identity.matrix() - Eigen::Matrix4d::Identity()).norm(), 1e-14);
  // A calibration replaces the one before, it does not add to it.
  const EstimatorRig again = corrected.with_calibration({{{}, {}}, {}});
  EXPECT_EQ(again.T_body_cams[1].translation, rig.T_body_cams[1].translation);
  EXPECT_EQ(again.tag_time(4), 0);
}

}  // namespace
}  // namespace vinebench::slam
