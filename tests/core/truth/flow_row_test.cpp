// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/truth/flow_row.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <opencv2/core.hpp>
#include <vector>

#include "core/geometry/pose.h"
#include "core/truth/truth_images.h"
#include "core/util/random.h"
#include "tests/support/vector_kinds.h"

namespace vinebench {
namespace {

// One pixel more than vectors of 2, 4 or 8 numbers fill.
constexpr int kOddWidth = 41;
constexpr int kFewRows = 30;
constexpr PinholeCamera kSmallCamera{
    .width = kOddWidth, .height = kFewRows, .fx = 30, .fy = 32, .cx = 19.7, .cy = 15.2};

/// Depths of 0.5 to 0.51 m in all directions, a tenth of them sky, with slanted normals: what is
/// visible by its depth, by its slope, and not at all.
TruthView rough_view(const Pose& T_world_cam, std::uint64_t seed) {
  TruthView view{kSmallCamera, T_world_cam, {}};
  view.image.depth = cv::Mat::zeros(kFewRows, kOddWidth, CV_32FC1);
  view.image.normals = cv::Mat::zeros(kFewRows, kOddWidth, CV_32FC3);
  const RandomStream random(seed, "rough view");
  std::uint64_t draws = 0;
  for (int y = 0; y < kFewRows; ++y) {
    for (int x = 0; x < kOddWidth; ++x) {
      if (random.uniform(draws++, 0, 1) < 0.1) continue;
      view.image.depth.at<float>(y, x) = static_cast<float>(random.uniform(draws++, 0.5, 0.51));
      const double across = random.uniform(draws++, -2, 2);
      const double down = random.uniform(draws++, -2, 2);
      const Eigen::Vector3d n = Eigen::Vector3d(across, down, -1).normalized();
      view.image.normals.at<cv::Vec3f>(y, x) = cv::Vec3f(
          static_cast<float>(n.x()), static_cast<float>(n.y()), static_cast<float>(n.z()));
    }
  }
  return view;
}

/// Whether b sees the point, as optical_flow() says it, a pixel at a time.
bool sees(const TruthView& b, bool sky, const Eigen::Vector3d& p) {
  const Eigen::Vector2d at = b.camera.project(p);
  if (!b.camera.contains(at)) return false;
  const auto u = std::min(static_cast<int>(std::floor(at.x() + 0.5)), kOddWidth - 1);
  const auto v = std::min(static_cast<int>(std::floor(at.y() + 0.5)), kFewRows - 1);
  const auto seen = static_cast<double>(b.image.depth.at<float>(v, u));
  if (sky || seen == 0) return sky && seen == 0;
  const cv::Vec3f& normal = b.image.normals.at<cv::Vec3f>(v, u);
  const Eigen::Vector3d n(normal[0], normal[1], normal[2]);
  const double facing = n.dot(b.camera.unproject({u, v}));
  const double met = seen * facing / n.dot(p / p.z());  // depth at which the ray meets the plane
  const double slope =
      seen * std::hypot(n.x() / b.camera.fx, n.y() / b.camera.fy) / std::abs(facing);
  const double allowed = seen * (1e-3 + 4e-6 * seen) + std::min(0.25 * slope, 0.01 * seen);
  return std::abs(p.z() - met) <= allowed;
}

// A camera that is moved by 2 cm and turned by 0.05 rad. At a threshold rounding may decide, which
// takes 1e-12 of what is compared: of 1230 pixels none is expected there.
TEST(FlowRowTest, EachKindOfVectorsSeesWhatOnePixelAtATimeSees) {
  const TruthView a = rough_view({}, 1);
  const TruthView b = rough_view({exp_so3({0.01, 0.05, -0.02}), {0.02, -0.005, 0.004}}, 2);
  const Pose T_b_a = b.T_world_cam.inverse() * a.T_world_cam;
  const FlowTruth first = optical_flow(a, b);
  test::with_each_kind_of_vectors([&] {
    const FlowTruth truth = optical_flow(a, b);
    EXPECT_EQ(std::memcmp(truth.flow.data, first.flow.data, 8 * first.flow.total()), 0);
    int visible = 0, hidden = 0;
    for (int y = 0; y < kFewRows; ++y) {
      for (int x = 0; x < kOddWidth; ++x) {
        const auto depth = static_cast<double>(a.image.depth.at<float>(y, x));
        const Eigen::Vector3d ray = kSmallCamera.unproject({x, y});
        const Eigen::Vector3d p = depth == 0 ? T_b_a.rotation * ray : T_b_a * (depth * ray);
        const cv::Vec2f& flow = truth.flow.at<cv::Vec2f>(y, x);
        // Floats of up to 60 px: 4e-6 px.
        ASSERT_NEAR(flow[0], b.camera.project(p).x() - x, 1e-5);
        ASSERT_NEAR(flow[1], b.camera.project(p).y() - y, 1e-5);
        ASSERT_EQ(truth.visible.at<std::uint8_t>(y, x), sees(b, depth == 0, p) ? 255 : 0)
            << x << ", " << y;
        ++(sees(b, depth == 0, p) ? visible : hidden);
      }
    }
    EXPECT_GT(visible, 200);
    EXPECT_GT(hidden, 200);
  });
}

// The camera has turned round: all is behind it.
TEST(FlowRowTest, WhatIsBehindTheCameraHasNoFlow) {
  const TruthView a = rough_view({}, 1);
  const TruthView b = rough_view({exp_so3({0, 3.14, 0}), {}}, 2);
  test::with_each_kind_of_vectors([&] {
    const FlowTruth truth = optical_flow(a, b);
    for (int x = 10; x < 30; ++x) {
      EXPECT_TRUE(std::isnan(truth.flow.at<cv::Vec2f>(15, x)[0]));
      EXPECT_TRUE(std::isnan(truth.flow.at<cv::Vec2f>(15, x)[1]));
      EXPECT_EQ(truth.visible.at<std::uint8_t>(15, x), 0);
    }
  });
}

// In rows of a larger image.
TEST(FlowRowTest, ImagesMayHaveGapsBetweenTheirRows) {
  const TruthView a = rough_view({}, 1);
  TruthView b = rough_view({Eigen::Quaterniond::Identity(), {0.02, 0, 0}}, 2);
  const FlowTruth dense = optical_flow(a, b);
  for (cv::Mat* image : {&b.image.depth, &b.image.normals}) {
    cv::Mat larger(kFewRows, kOddWidth + 5, image->type(), cv::Scalar::all(7));
    cv::Mat part = larger.colRange(3, 3 + kOddWidth);
    image->copyTo(part);
    *image = part;
  }
  const FlowTruth truth = optical_flow(a, b);
  EXPECT_EQ(cv::norm(truth.visible, dense.visible, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(truth.flow, dense.flow, cv::NORM_INF), 0);
}

}  // namespace
}  // namespace vinebench
