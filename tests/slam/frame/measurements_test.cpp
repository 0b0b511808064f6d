// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/frame/measurements.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "slam/camera/estimator_rig.h"
#include "tests/support/synthetic_aisle.h"

namespace vinebench::slam {
namespace {

using test::SyntheticAisle;

TEST(MeasurementsTest, MeasuresWithTheRightCameraWhereThereIsADepth) {
  const SyntheticAisle aisle(0, 1, 300);
  const EstimatorRig rig(aisle.rig, OrbConfig{});
  StereoView view = aisle.frame(0, Pose{})->views[0];
  view.features.keypoints[2].level = 3;
  view.stereo[3] = StereoMatch{100, -1};  // matched, but beyond the limit
  view.stereo[4] = StereoMatch{};
  const PixelMeasurement m = measure(view, 2, rig.noise);
  EXPECT_EQ(m.pixel.x(), static_cast<double>(view.features.keypoints[2].x));
  EXPECT_EQ(m.pixel.y(), static_cast<double>(view.features.keypoints[2].y));
  ASSERT_TRUE(m.right_x);
  EXPECT_EQ(*m.right_x, static_cast<double>(view.stereo[2].x_right));
  EXPECT_NEAR(m.sigma, 1.2 * 1.2 * 1.2, 1e-12);
  EXPECT_FALSE(measure(view, 3, rig.noise).right_x);
  EXPECT_FALSE(measure(view, 4, rig.noise).right_x);
}

TEST(MeasurementsTest, StereoPutsAPointWhereItIs) {
  const SyntheticAisle aisle(0, 1, 300);
  const EstimatorRig rig(aisle.rig, OrbConfig{});
  const Pose body{exp_so3({0.02, 0.01, 0.4}), {0.3, 0.1, 0.02}};
  const auto frame = aisle.frame(0, body);
  for (std::size_t k = 0; k < 2; ++k) {
    const StereoView& view = frame->views[k];
    ASSERT_GT(view.features.size(), 5u);
    for (std::size_t f = 0; f < view.features.size(); ++f) {
      const auto& truth = aisle.point(aisle.point_of(view.features.descriptors[f]));
      const Eigen::Vector3d point = stereo_point(*frame, k, static_cast<int>(f), body, rig);
      EXPECT_LT((point - truth).norm(), 1e-6);  // floats: 1e-7 of up to 4.8 m
    }
  }
}

TEST(MeasurementsTest, AViewIsSeenFromWhereTheBodyWasThen) {
  const SyntheticAisle aisle(0, 1, 300);
  const EstimatorRig rig(aisle.rig, OrbConfig{});
  const Pose body{exp_so3({0.02, 0.01, 0.4}), {0.3, 0.1, 0.02}};
  auto frame = aisle.frame(0, body);
  frame->velocity << 2, 0, 0, 0, 0, 0.5;
  frame->views[1].late = -0.01;
  EXPECT_EQ(view_pose(*frame, 0, body, rig).translation, body.translation);
  EXPECT_EQ(view_pose(*frame, 0, body, rig).rotation.coeffs(), body.rotation.coeffs());
  const Pose step = body.inverse() * view_poses(*frame, body, rig).at(1);
  EXPECT_LT((step.translation - Eigen::Vector3d(-0.02, 0, 0)).norm(), 1e-12);
  EXPECT_LT((log_so3(step.rotation) - Eigen::Vector3d(0, 0, -0.005)).norm(), 1e-9);
  EXPECT_EQ(measure(frame->views[1], 0, rig.noise).late, -0.01);
}

// A pair that self-calibration found to be 10 ms late and to take 30 ms from row to row sees points
// from where the body is by then: they are where they are. Without its times they would be up to 25
// ms, 1 cm and 15 mrad off. Floats are good to 1e-6 m; a row's time to that of five rounds.
TEST(MeasurementsTest, StereoKnowsWhenARowWasExposed) {
  SyntheticAisle aisle(0, 1, 300);
  PairCalibration late;
  late.time = 0.010;
  late.readout = 0.030;
  aisle.calibration[1] = late;
  aisle.velocity << 0.4, 0.1, 0, 0, 0, 0.6;
  const EstimatorRig told = EstimatorRig(aisle.rig, OrbConfig{}).with_calibration({{{}, late}, {}});
  const Pose body{exp_so3({0.02, 0.01, 0.4}), {0.3, 0.1, 0.02}};
  const auto frame = aisle.frame(0, body);
  const StereoView& view = frame->views[1];
  ASSERT_GT(view.features.size(), 5u);
  double worst_untold = 0;
  for (std::size_t f = 0; f < view.features.size(); ++f) {
    const auto& truth = aisle.point(aisle.point_of(view.features.descriptors[f]));
    const int feature = static_cast<int>(f);
    EXPECT_LT((stereo_point(*frame, 1, feature, body, told) - truth).norm(), 2e-6);
    const EstimatorRig untold(aisle.rig, OrbConfig{});
    worst_untold =
        std::max(worst_untold, (stereo_point(*frame, 1, feature, body, untold) - truth).norm());
  }
  EXPECT_GT(worst_untold, 0.01);  // m
}

// Half a pixel more of disparity, and the depth that this is. What lies beyond the limit has no
// depth any more, and keeps its match.
TEST(MeasurementsTest, CorrectsDepthsByTheDisparityOffset) {
  const SyntheticAisle aisle(0, 1, 300);
  const EstimatorRig rig(aisle.rig, OrbConfig{});
  const double limit = StereoConfig{}.max_depth_baselines;
  const StereoView view = aisle.frame(0, Pose{})->views[0];
  StereoView corrected = view;
  correct_depths(rig.left_cameras[0], limit, corrected);
  EXPECT_EQ(corrected.stereo[5].depth, view.stereo[5].depth);
  const EstimatorRig found = rig.with_calibration({{{{}, 0.5}, {}}, {}});
  corrected.stereo[3].x_right = view.features.keypoints[3].x - 0.1F;
  correct_depths(found.left_cameras[0], limit, corrected);
  const StereoCameraModel& camera = rig.left_cameras[0];
  const double disparity =
      static_cast<double>(view.features.keypoints[5].x - view.stereo[5].x_right);
  EXPECT_NEAR(corrected.stereo[5].depth, camera.lens.fx * camera.baseline / (disparity + 0.5),
              1e-6);
  EXPECT_EQ(corrected.stereo[5].x_right, view.stereo[5].x_right);
  EXPECT_EQ(corrected.stereo[3].depth, -1);
}

}  // namespace
}  // namespace vinebench::slam
