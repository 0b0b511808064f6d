// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/truth/truth_images.h"

#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "core/truth/flow_row.h"
#include "core/util/error.h"

namespace vinebench {
namespace {

constexpr double kSameAxes = 1e-6;        // rad, of the cameras and of the baseline off the x axis
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

cv::Mat without_gaps(const cv::Mat& image) {
  return image.isContinuous() ? image : image.clone();
}

/// The positions in b of the points seen by a's pixels.
class Warp {
 public:
  Warp(const TruthView& a, const TruthView& b) : a_(a) {
    check(a, "the first");
    check(b, "the second");
    const Pose T_b_a = b.T_world_cam.inverse() * a.T_world_cam;
    R_b_a_ = T_b_a.rotation.toRotationMatrix();
    t_b_a_ = T_b_a.translation;
    R_b_world_ = b.T_world_cam.rotation.conjugate().toRotationMatrix();
    depth_ = without_gaps(b.image.depth);
    normals_ = without_gaps(b.image.normals);
    const PinholeCamera& to = b.camera;
    target_ = {to.width,
               to.height,
               to.fx,
               to.fy,
               to.cx,
               to.cy,
               depth_.ptr<float>(),
               normals_.ptr<float>()};
  }

  FlowTruth flow() const {
    const cv::Size size(a_.camera.width, a_.camera.height);
    FlowTruth truth{cv::Mat(size, CV_32FC2), cv::Mat(size, CV_8UC1)};
    FlowPoints points(columns_.size());
    for (int y = 0; y < size.height; ++y) {
      const auto* depths = a_.image.depth.ptr<float>(y);
      place_points(depths, columns_, row_in_b(y), points);
      if (!a_.image.motion.empty()) move(y, depths, points);
      find_points(target_, depths, y, points, truth.flow.ptr<float>(y),
                  truth.visible.ptr<std::uint8_t>(y));
    }
    return truth;
  }

 private:
  RowInView row_in_b(int y) const {
    const Eigen::Vector3d ahead =
        R_b_a_.col(1) * rows_[static_cast<std::size_t>(y)] + R_b_a_.col(2);
    RowInView row;
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      row.across[i] = R_b_a_(axis, 0);
      row.ahead[i] = ahead[axis];
      row.moved[i] = t_b_a_[axis];
    }
    return row;
  }

  /// By the wind or with the rover. Most points stand still.
  void move(int y, const float* depths, FlowPoints& points) const {
    const auto* motion = a_.image.motion.ptr<cv::Vec3f>(y);
    for (std::size_t x = 0; x < points.x.size(); ++x) {
      const cv::Vec3f& m = motion[x];
      if (depths[x] == 0 || (m[0] == 0 && m[1] == 0 && m[2] == 0)) continue;
      const Eigen::Vector3d moved = R_b_world_ * Eigen::Vector3d(m[0], m[1], m[2]);
      points.x[x] += moved.x();
      points.y[x] += moved.y();
      points.z[x] += moved.z();
    }
  }

  const TruthView& a_;
  Eigen::Matrix3d R_b_a_;
  Eigen::Vector3d t_b_a_;
  Eigen::Matrix3d R_b_world_;
  cv::Mat depth_, normals_;  // of b
  FlowTarget target_;
  std::vector<double> columns_ = rays(a_.camera.width, a_.camera.fx, a_.camera.cx);
  std::vector<double> rows_ = rays(a_.camera.height, a_.camera.fy, a_.camera.cy);
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
  return Warp(a, b).flow();
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
