// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/truth/truth_images.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <vector>

#include "core/util/error.h"

namespace vinebench {
namespace {

constexpr double kNearest = 1e-3;      // m in front of a camera; nearer points are not in its image
constexpr double kShare = 1e-3;        // of depth: levels of detail, rounding
constexpr double kResolution = 4e-6;   // 1/m: depth of 32 bits from 0.03 m on, twice
constexpr double kSlopeShare = 0.25;   // px, of the depth's slope
constexpr double kMostBySlope = 0.01;  // of depth
constexpr double kSameAxes = 1e-6;     // rad, of the cameras and of the baseline off the x axis
constexpr double kSameIntrinsics = 1e-9;  // px

void check(const TruthView& view, const char* which) {
  const cv::Size size(view.camera.width, view.camera.height);
  if (view.camera.has_distortion()) {
    fail("truth images: {} camera has lens distortion, expected an ideal pinhole", which);
  }
  const RenderedImage& image = view.image;
  if (image.depth.size() != size || image.depth.type() != CV_32FC1 ||
      image.normals.size() != size || image.normals.type() != CV_32FC3) {
    fail("truth images: expected depth and normals of {} x {} pixels with {} image", size.width,
         size.height, which);
  }
}

/// Directions (z = 1) of the rays through the pixel centres, along one axis of the image.
std::vector<double> rays(int size, double focal, double centre) {
  std::vector<double> at(static_cast<std::size_t>(size));
  for (int i = 0; i < size; ++i) at[static_cast<std::size_t>(i)] = (i - centre) / focal;
  return at;
}

/// The position in b of the point seen by a pixel of a.
class Warp {
 public:
  Warp(const TruthView& a, const TruthView& b) : a_(a), b_(b) {
    check(a, "the first");
    check(b, "the second");
    const Pose T_b_a = b.T_world_cam.inverse() * a.T_world_cam;
    R_b_a_ = T_b_a.rotation.toRotationMatrix();
    t_b_a_ = T_b_a.translation;
  }

  /// Point in camera b's frame; for sky, the direction.
  Eigen::Vector3d point(int x, int y) const {
    const double depth = a_.image.depth.at<float>(y, x);
    const Eigen::Vector3d ray =
        R_b_a_.col(0) * a_columns_[static_cast<std::size_t>(x)] +
        (R_b_a_.col(1) * a_rows_[static_cast<std::size_t>(y)] + R_b_a_.col(2));
    if (depth == 0) return ray;
    const Eigen::Vector3d p = depth * ray + t_b_a_;
    return a_.image.motion.empty() ? p : Eigen::Vector3d(p + motion(x, y));
  }

  bool is_sky(int x, int y) const { return a_.image.depth.at<float>(y, x) == 0; }

  /// Whether the point, or the sky, is visible in b at a position of its image.
  bool shows(const Eigen::Vector2d& place, const Eigen::Vector3d& point, bool sky) const {
    if (!b_.camera.contains(place)) return false;
    // The nearest pixel; positions begin at -0.5.
    const int x = std::min(static_cast<int>(place.x() + 0.5), b_.camera.width - 1);
    const int y = std::min(static_cast<int>(place.y() + 0.5), b_.camera.height - 1);
    const double seen = b_.image.depth.at<float>(y, x);
    if (sky || seen == 0) return sky && seen == 0;
    return agrees(x, y, seen, point);
  }

 private:
  /// By the wind, in camera b's frame.
  Eigen::Vector3d motion(int x, int y) const {
    const auto& m = a_.image.motion.at<cv::Vec3f>(y, x);
    return b_.T_world_cam.rotation.conjugate() * Eigen::Vector3d(m[0], m[1], m[2]);
  }

  /// The plane seen at pixel (x, y) is n . p = n . (seen * ray); a ray of z = 1 meets it at the
  /// depth n . (seen * ray) / n . ray'.
  bool agrees(int x, int y, double seen, const Eigen::Vector3d& point) const {
    const auto& normal = b_.image.normals.at<cv::Vec3f>(y, x);
    const Eigen::Vector3d n(normal[0], normal[1], normal[2]);
    const double facing = n.x() * b_columns_[static_cast<std::size_t>(x)] +
                          n.y() * b_rows_[static_cast<std::size_t>(y)] + n.z();
    const double expected = seen * facing * point.z() / n.dot(point);
    const double off = std::abs(point.z() - expected) - kShare * seen - kResolution * seen * seen;
    if (!(off > 0)) return off <= 0;  // nearly all, and NaN
    const double slope = seen * Eigen::Vector2d(n.x() / b_.camera.fx, n.y() / b_.camera.fy).norm() /
                         std::abs(facing);
    return off <= std::min(kSlopeShare * slope, kMostBySlope * seen);
  }

  const TruthView& a_;
  const TruthView& b_;
  Eigen::Matrix3d R_b_a_;
  Eigen::Vector3d t_b_a_;
  std::vector<double> a_columns_ = rays(a_.camera.width, a_.camera.fx, a_.camera.cx);
  std::vector<double> a_rows_ = rays(a_.camera.height, a_.camera.fy, a_.camera.cy);
  std::vector<double> b_columns_ = rays(b_.camera.width, b_.camera.fx, b_.camera.cx);
  std::vector<double> b_rows_ = rays(b_.camera.height, b_.camera.fy, b_.camera.cy);
};

void check_rectified(const TruthView& left, const TruthView& right) {
  const Pose T_left_right = left.T_world_cam.inverse() * right.T_world_cam;
  const Eigen::Vector3d& t = T_left_right.translation;
  const PinholeCamera& l = left.camera;
  const PinholeCamera& r = right.camera;
  const auto same = [](double a, double b) { return std::abs(a - b) <= kSameIntrinsics; };
  if (angle_of(T_left_right.rotation) > kSameAxes || t.x() <= 0 ||
      t.tail<2>().norm() > kSameAxes * t.x() || !same(l.fx, r.fx) || !same(l.fy, r.fy) ||
      !same(l.cy, r.cy)) {
    fail(
        "disparity: the views are not a rectified pair, expected the right camera beside the left "
        "one "
        "along its x axis, with the same orientation, focal lengths and cy");
  }
}

/// PinholeCamera::project() of a camera without distortion, inlined: it is called for each pixel.
Eigen::Vector2d ideal(const PinholeCamera& camera, const Eigen::Vector3d& point) {
  return {camera.fx * (point.x() / point.z()) + camera.cx,
          camera.fy * (point.y() / point.z()) + camera.cy};
}

}  // namespace

FlowTruth optical_flow(const TruthView& a, const TruthView& b) {
  const Warp warp(a, b);
  const cv::Size size(a.camera.width, a.camera.height);
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  FlowTruth truth{cv::Mat(size, CV_32FC2), cv::Mat(size, CV_8UC1)};
  for (int y = 0; y < size.height; ++y) {
    auto* flow = truth.flow.ptr<cv::Vec2f>(y);
    auto* visible = truth.visible.ptr<std::uint8_t>(y);
    for (int x = 0; x < size.width; ++x) {
      const Eigen::Vector3d point = warp.point(x, y);
      const bool ahead = point.z() > kNearest;
      const Eigen::Vector2d place = ahead ? ideal(b.camera, point) : Eigen::Vector2d::Zero();
      flow[x] =
          ahead ? cv::Vec2f(static_cast<float>(place.x() - x), static_cast<float>(place.y() - y))
                : cv::Vec2f(kNone, kNone);
      visible[x] = ahead && warp.shows(place, point, warp.is_sky(x, y)) ? 255 : 0;
    }
  }
  return truth;
}

DisparityTruth disparity(const TruthView& left, const TruthView& right) {
  check_rectified(left, right);
  TruthView still = left;
  still.image.motion.release();
  const FlowTruth truth = optical_flow(still, right);
  DisparityTruth result;
  cv::extractChannel(cv::Mat(-truth.flow), result.disparity, 0);
  result.visible = truth.visible;
  return result;
}

}  // namespace vinebench
