// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/truth/truth_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/test_folder.h"

namespace vinebench {
namespace {

using test::error_of;
using testing::HasSubstr;

constexpr PinholeCamera kCamera{
    .width = 60, .height = 40, .fx = 50, .fy = 50, .cx = 29.5, .cy = 19.5};
constexpr double kWall = 4;        // m, along z from the origin
constexpr double kPost = 2;        // m, likewise
constexpr double kPostHalf = 0.2;  // m

/// Camera axes and world axes are the same: x right, y down, z ahead.
Pose camera_at(double x, double y = 0, double z = 0) {
  return {Eigen::Quaterniond::Identity(), {x, y, z}};
}

/// A post of infinite height, |x| < 0.2 m at z = 2 m, before a wall at z = 4 m that begins at
/// y = 0; above it there is sky.
TruthView view(const Pose& T_world_cam) {
  TruthView view{kCamera, T_world_cam, {}};
  const cv::Size size(kCamera.width, kCamera.height);
  view.image.depth = cv::Mat::zeros(size, CV_32FC1);
  view.image.normals = cv::Mat::zeros(size, CV_32FC3);
  const Eigen::Vector3d& at = T_world_cam.translation;
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const Eigen::Vector3d ray = kCamera.unproject({u, v});
      const double x_at_post = at.x() + (kPost - at.z()) * ray.x();
      const double y_at_wall = at.y() + (kWall - at.z()) * ray.y();
      const bool post = at.z() < kPost && std::abs(x_at_post) < kPostHalf;
      if (!post && y_at_wall < 0) continue;
      view.image.depth.at<float>(v, u) = static_cast<float>((post ? kPost : kWall) - at.z());
      view.image.normals.at<cv::Vec3f>(v, u) = {0, 0, -1};
    }
  }
  return view;
}

// 50 px * 0.2 m / 4 m = 2.5 px at the wall, 5 px at the post.
TEST(TruthImagesTest, DisparityIsFocalLengthTimesBaselineByDepth) {
  const DisparityTruth truth = disparity(view(camera_at(0)), view(camera_at(0.2)));
  // Depths are floats: 1e-7 of them, far below 1e-4 px.
  EXPECT_NEAR(truth.disparity.at<float>(30, 50), 2.5, 1e-4);
  EXPECT_NEAR(truth.disparity.at<float>(30, 29), 5, 1e-4);
  EXPECT_EQ(truth.disparity.at<float>(5, 50), 0);  // sky
  EXPECT_EQ(truth.visible.at<std::uint8_t>(30, 50), 255);
  EXPECT_EQ(truth.visible.at<std::uint8_t>(5, 50), 255);
}

// The right camera sees the wall through the post where |x| < 0.2 m of the line from (0.2, 0) to
// (X, 4) at z = 2: -0.6 m < X < 0.2 m. The left camera's own post covers |X| < 0.4 m: of the
// remaining wall, -0.6 m to -0.4 m is hidden, columns 22.0 to 24.5.
TEST(TruthImagesTest, WhatThePostHidesFromTheOtherCameraIsNotVisible) {
  const DisparityTruth truth = disparity(view(camera_at(0)), view(camera_at(0.2)));
  const auto visible = [&](int u) { return truth.visible.at<std::uint8_t>(30, u) != 0; };
  EXPECT_TRUE(visible(20));
  EXPECT_FALSE(visible(23));
  EXPECT_FALSE(visible(24));
  EXPECT_TRUE(visible(26));  // the post itself
  EXPECT_TRUE(visible(36));
  EXPECT_FALSE(visible(0));  // left of the right camera's image: u - 2.5 < -0.5
}

TEST(TruthImagesTest, PointsMoveAsTheirMotionSays) {
  TruthView a = view(camera_at(0));
  a.image.motion = cv::Mat(a.image.depth.size(), CV_32FC3, cv::Scalar(0.08, 0, 0));
  const FlowTruth truth = optical_flow(a, view(camera_at(0)));
  // 50 px * 0.08 m / 4 m to the right.
  EXPECT_NEAR(truth.flow.at<cv::Vec2f>(30, 50)[0], 1, 1e-4);
  EXPECT_NEAR(truth.flow.at<cv::Vec2f>(30, 50)[1], 0, 1e-4);
  EXPECT_EQ(truth.flow.at<cv::Vec2f>(5, 50)[0], 0);  // the sky stays
  // A pair is of one instant.
  EXPECT_NEAR(disparity(a, view(camera_at(0.2))).disparity.at<float>(30, 50), 2.5, 1e-4);
}

// From z = 3 m the post is behind the camera. The wall at 1 m: a point 1 m right of the axis, 12.5
// px from the centre before, is 50 px from it.
TEST(TruthImagesTest, WhatIsBehindTheOtherCameraHasNoFlow) {
  const FlowTruth truth = optical_flow(view(camera_at(0)), view(camera_at(0, 0, 3)));
  EXPECT_TRUE(std::isnan(truth.flow.at<cv::Vec2f>(30, 29)[0]));
  EXPECT_EQ(truth.visible.at<std::uint8_t>(30, 29), 0);
  EXPECT_NEAR(truth.flow.at<cv::Vec2f>(30, 42)[0], 50 - 12.5, 1e-3);
  EXPECT_EQ(truth.visible.at<std::uint8_t>(30, 42), 0);  // outside of the image
}

TEST(TruthImagesTest, WrongViewsAreErrors) {
  const TruthView left = view(camera_at(0)), right = view(camera_at(0.2));
  TruthView lacking = right;
  lacking.image.normals.release();
  EXPECT_THAT(error_of([&] { optical_flow(left, lacking); }),
              HasSubstr("expected depth and normals"));
  TruthView bent = right;
  bent.camera.distortion[0] = 0.1;
  EXPECT_THAT(error_of([&] { optical_flow(left, bent); }), HasSubstr("distortion"));
  EXPECT_THAT(error_of([&] { disparity(right, left); }), HasSubstr("not a rectified pair"));
  TruthView turned = right;
  turned.T_world_cam.rotation = turned.T_world_cam.rotation * exp_so3({0, 0.01, 0});
  EXPECT_THAT(error_of([&] { disparity(left, turned); }), HasSubstr("not a rectified pair"));
  TruthView zoomed = right;
  zoomed.camera.fx = 51;
  EXPECT_THAT(error_of([&] { disparity(left, zoomed); }), HasSubstr("not a rectified pair"));
}

}  // namespace
}  // namespace vinebench
