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
      const double depth = first_depth(rig.left_cameras[k], 40, view, f).value();
      const Eigen::Vector3d point = stereo_point(*frame, k, static_cast<int>(f), depth, body, rig);
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
    const auto depth = static_cast<double>(view.stereo[f].depth);
    EXPECT_LT((stereo_point(*frame, 1, feature, depth, body, told) - truth).norm(), 2e-6);
    const EstimatorRig untold(aisle.rig, OrbConfig{});
    worst_untold = std::max(worst_untold,
                            (stereo_point(*frame, 1, feature, depth, body, untold) - truth).norm());
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

/// A lens of 100 px and a baseline of 0.1 m: a disparity of 1 px is 10 m, or 100 baselines.
class FarDepthTest : public testing::Test {
 protected:
  FarDepthTest() {
    camera_.lens = {.width = 640, .height = 480, .fx = 100, .fy = 100, .cx = 320, .cy = 240};
    camera_.baseline = 0.1;
    view_.features.keypoints.resize(4);
    for (Keypoint& keypoint : view_.features.keypoints) keypoint.x = 50;
    view_.stereo.resize(4);
    view_.stereo[0] = {.x_right = 40, .depth = 1};  // near
    view_.stereo[1].x_right = 49;                   // 100 baselines
    view_.stereo[2].x_right = 49.5F;                // 200 baselines: beyond the farther limit too
  }                                                 // no match at all: the fourth

  StereoCameraModel camera_;
  StereoView view_;
};

TEST_F(FarDepthTest, LandmarksBeginFartherThanDepthsAreMeasured) {
  EXPECT_EQ(first_depth(camera_, 150, view_, 0), 1);
  EXPECT_NEAR(first_depth(camera_, 150, view_, 1).value(), 10, 1e-12);
  EXPECT_FALSE(first_depth(camera_, 150, view_, 2));
  EXPECT_FALSE(first_depth(camera_, 150, view_, 3));
  EXPECT_FALSE(measure(view_, 1, MeasurementNoise{.level_scales = {1}}).right_x);
}

TEST_F(FarDepthTest, TheyAreMeasuredToTooWhereLittleIsNear) {
  StereoConfig config;
  config.few_near = 1;
  reach_farther(camera_, config, view_);
  EXPECT_EQ(view_.stereo[1].depth, -1);  // one near point is enough
  config.few_near = 2;
  reach_farther(camera_, config, view_);
  EXPECT_FLOAT_EQ(view_.stereo[0].depth, 1);
  EXPECT_FLOAT_EQ(view_.stereo[1].depth, 10);
  EXPECT_EQ(view_.stereo[2].depth, -1);
  EXPECT_EQ(view_.stereo[3].depth, -1);
}

}  // namespace
}  // namespace vinebench::slam
