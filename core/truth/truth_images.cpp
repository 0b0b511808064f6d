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

/// A row of a's points in camera b's frame, directions for sky, and their places in b's image.
/// Coordinates apart, so that the compiler takes several pixels at once.
struct Row {
  using Numbers = std::vector<double>;

  explicit Row(std::size_t width)
      : near(width), reach(width), x(width), y(width), z(width), u(width), v(width) {}
  Numbers near;     ///< 0 for sky, else 1
  Numbers reach;    ///< depth in a, m; of sky 1
  Numbers x, y, z;  ///< m
  Numbers u, v;     ///< px; of what is behind the camera they mean nothing
};

/// The positions in b of the points seen by a's pixels.
class Warp {
 public:
  Warp(const TruthView& a, const TruthView& b) : a_(a), b_(b) {
    check(a, "the first");
    check(b, "the second");
    const Pose T_b_a = b.T_world_cam.inverse() * a.T_world_cam;
    R_b_a_ = T_b_a.rotation.toRotationMatrix();
    t_b_a_ = T_b_a.translation;
    R_b_world_ = b.T_world_cam.rotation.conjugate().toRotationMatrix();
  }

  void place(int y, Row& row) const {
    const std::size_t width = a_columns_.size();
    const auto* depth = a_.image.depth.ptr<float>(y);
    for (std::size_t x = 0; x < width; ++x) {
      row.near[x] = depth[x] != 0 ? 1 : 0;
      row.reach[x] = static_cast<double>(depth[x]) + (1 - row.near[x]);
    }
    const Eigen::Vector3d begin =
        R_b_a_.col(1) * a_rows_[static_cast<std::size_t>(y)] + R_b_a_.col(2);
    for (int axis = 0; axis < 3; ++axis) {
      double* const at = (axis == 0 ? row.x : axis == 1 ? row.y : row.z).data();
      const double across = R_b_a_(axis, 0);
      const double ahead = begin[axis];
      const double moved = t_b_a_[axis];
      for (std::size_t x = 0; x < width; ++x) {
        at[x] = row.reach[x] * (across * a_columns_[x] + ahead) + row.near[x] * moved;
      }
    }
    if (!a_.image.motion.empty()) move(y, row);
    const PinholeCamera& to = b_.camera;
    for (std::size_t x = 0; x < width; ++x) {
      row.u[x] = to.fx * (row.x[x] / row.z[x]) + to.cx;
      row.v[x] = to.fy * (row.y[x] / row.z[x]) + to.cy;
    }
  }

  /// Whether the point of a row, or the sky, is visible in b.
  bool shows(const Row& row, std::size_t i) const {
    if (!b_.camera.contains({row.u[i], row.v[i]})) return false;
    // The nearest pixel; positions begin at -0.5.
    const int x = std::min(static_cast<int>(row.u[i] + 0.5), b_.camera.width - 1);
    const int y = std::min(static_cast<int>(row.v[i] + 0.5), b_.camera.height - 1);
    const double seen = b_.image.depth.ptr<float>(y)[x];
    const bool sky = row.near[i] == 0;
    if (sky || seen == 0) return sky && seen == 0;
    return agrees(x, y, seen, {row.x[i], row.y[i], row.z[i]});
  }

 private:
  /// By the wind or with the rover. Most points stand still.
  void move(int y, Row& row) const {
    const auto* motion = a_.image.motion.ptr<cv::Vec3f>(y);
    for (std::size_t x = 0; x < row.x.size(); ++x) {
      const cv::Vec3f& m = motion[x];
      if (row.near[x] == 0 || (m[0] == 0 && m[1] == 0 && m[2] == 0)) continue;
      const Eigen::Vector3d moved = R_b_world_ * Eigen::Vector3d(m[0], m[1], m[2]);
      row.x[x] += moved.x();
      row.y[x] += moved.y();
      row.z[x] += moved.z();
    }
  }

  /// The plane seen at pixel (x, y) is n . p = n . (seen * ray); a ray of z = 1 meets it at the
  /// depth n . (seen * ray) / n . ray'.
  bool agrees(int x, int y, double seen, const Eigen::Vector3d& point) const {
    const cv::Vec3f& normal = b_.image.normals.ptr<cv::Vec3f>(y)[x];
    const Eigen::Vector3d n(normal[0], normal[1], normal[2]);
    const double facing = n.x() * b_columns_[static_cast<std::size_t>(x)] +
                          n.y() * b_rows_[static_cast<std::size_t>(y)] + n.z();
    // Both sides times n . ray' * z: divisions are for the few that do not agree at once.
    const double along = n.dot(point);
    const double off = std::abs(point.z() * (along - seen * facing));
    const double usual = seen * (kShare + kResolution * seen);
    if (!(std::abs(along) > 0)) return false;
    if (off <= usual * std::abs(along)) return true;
    const double slope = seen * Eigen::Vector2d(n.x() / b_.camera.fx, n.y() / b_.camera.fy).norm() /
                         std::abs(facing);
    return off / std::abs(along) - usual <= std::min(kSlopeShare * slope, kMostBySlope * seen);
  }

  const TruthView& a_;
  const TruthView& b_;
  Eigen::Matrix3d R_b_a_;
  Eigen::Vector3d t_b_a_;
  Eigen::Matrix3d R_b_world_;
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

}  // namespace

FlowTruth optical_flow(const TruthView& a, const TruthView& b) {
  const Warp warp(a, b);
  const cv::Size size(a.camera.width, a.camera.height);
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  FlowTruth truth{cv::Mat(size, CV_32FC2), cv::Mat(size, CV_8UC1)};
  Row row(static_cast<std::size_t>(size.width));
  for (int y = 0; y < size.height; ++y) {
    warp.place(y, row);
    auto* flow = truth.flow.ptr<cv::Vec2f>(y);
    auto* visible = truth.visible.ptr<std::uint8_t>(y);
    for (std::size_t x = 0; x < row.z.size(); ++x) {
      const bool ahead = row.z[x] > kNearest;
      flow[x] = ahead ? cv::Vec2f(static_cast<float>(row.u[x] - static_cast<double>(x)),
                                  static_cast<float>(row.v[x] - y))
                      : cv::Vec2f(kNone, kNone);
      visible[x] = ahead && warp.shows(row, x) ? 255 : 0;
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
