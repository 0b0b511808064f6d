// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/camera/estimator_rig.h"

#include <gtest/gtest.h>

#include "tests/support/synthetic_aisle.h"

namespace vinebench::slam {
namespace {

using testing_support::SyntheticAisle;

TEST(EstimatorRigTest, MeasuresWithTheRightCameraWhereThereIsADepth) {
  const SyntheticAisle aisle(0, 1, 300);
  const EstimatorRig rig(aisle.rig, OrbConfig{});
  StereoView view = aisle.frame(0, Pose{})->views[0];
  view.features.keypoints[2].level = 3;
  view.stereo[3] = StereoMatch{100, -1};  // matched, but beyond the limit
  view.stereo[4] = StereoMatch{};
  const PixelMeasurement m = rig.measurement(view, 2);
  EXPECT_EQ(m.pixel.x(), static_cast<double>(view.features.keypoints[2].x));
  EXPECT_EQ(m.pixel.y(), static_cast<double>(view.features.keypoints[2].y));
  ASSERT_TRUE(m.right_x);
  EXPECT_EQ(*m.right_x, static_cast<double>(view.stereo[2].x_right));
  EXPECT_NEAR(m.sigma, 1.2 * 1.2 * 1.2, 1e-12);
  EXPECT_FALSE(rig.measurement(view, 3).right_x);
  EXPECT_FALSE(rig.measurement(view, 4).right_x);
}

TEST(EstimatorRigTest, StereoPutsAPointWhereItIs) {
  const SyntheticAisle aisle(0, 1, 300);
  const EstimatorRig rig(aisle.rig, OrbConfig{});
  const Pose body{exp_so3({0.02, 0.01, 0.4}), {0.3, 0.1, 0.02}};
  const auto frame = aisle.frame(0, body);
  for (int v = 0; v < 2; ++v) {
    const StereoView& view = frame->views[static_cast<std::size_t>(v)];
    ASSERT_GT(view.features.size(), 5u);
    for (std::size_t f = 0; f < view.features.size(); ++f) {
      const auto& truth = aisle.point(aisle.point_of(view.features.descriptors[f]));
      const Eigen::Vector3d point = rig.stereo_point(view, v, static_cast<int>(f), body);
      EXPECT_LT((point - truth).norm(), 1e-6);  // floats: 1e-7 of up to 4.8 m
    }
  }
}

// Half a pixel more of disparity, and the depth that this is. Matches beyond the limit lose their
// depth and remain matches.
TEST(EstimatorRigTest, CorrectsDepthsByTheDisparityOffset) {
  const SyntheticAisle aisle(0, 1, 300);
  EstimatorRig rig(aisle.rig, OrbConfig{});
  const StereoView view = aisle.frame(0, Pose{})->views[0];
  StereoView corrected = view;
  rig.correct_depths(0, corrected);
  EXPECT_EQ(corrected.stereo[5].depth, view.stereo[5].depth);
  rig.set_disparity_offsets({0.5, 0});
  corrected.stereo[3].x_right = view.features.keypoints[3].x - 0.1F;
  rig.correct_depths(0, corrected);
  const StereoCameraModel& camera = rig.left_cameras[0];
  const double disparity =
      static_cast<double>(view.features.keypoints[5].x - view.stereo[5].x_right);
  EXPECT_NEAR(corrected.stereo[5].depth, camera.lens.fx * camera.baseline / (disparity + 0.5),
              1e-6);
  EXPECT_EQ(corrected.stereo[5].x_right, view.stereo[5].x_right);
  EXPECT_EQ(corrected.stereo[3].depth, -1);
}

TEST(EstimatorRigTest, TagCamerasHaveNoDistortionLeft) {
  Rig bent = load_rig(VINEBENCH_SOURCE_DIR "/models/csl-rover/rig.yaml");
  bent.cameras[4].model.distortion = {-0.05, 0, 0, 0};
  const EstimatorRig rig(make_stereo_rig(bent, {}), OrbConfig{});
  ASSERT_EQ(rig.undistorted_cameras.size(), 5u);
  EXPECT_FALSE(rig.undistorted_cameras[4].lens.has_distortion());
  EXPECT_EQ(rig.undistorted_cameras[4].lens.fx, 733);
  const Pose identity = rig.undistorted_cameras[4].T_cam_body * bent.cameras[4].T_body_cam;
  EXPECT_LT((identity.matrix() - Eigen::Matrix4d::Identity()).norm(), 1e-14);
}

}  // namespace
}  // namespace vinebench::slam
