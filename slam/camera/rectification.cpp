// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/camera/rectification.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "core/util/error.h"

namespace vinebench::slam {
namespace {

constexpr double kMinBaseline = 1e-3;      // m
constexpr double kMinAlignment = 0.5;      // cosine of an axis's turn into the common view
constexpr int kBorderSamples = 33;         // on a side
constexpr double kLensTolerance = 0.01;    // px of a pixel through the lens and back
constexpr double kRadiusTolerance = 1.02;  // of the squared radius of the image's corners
constexpr double kWidestView = 1.43;       // tangent of 55 degrees: a plane wastes what is farther
                                           // aside, where fisheyes see too
constexpr float kNowhere = -1000;          // px
constexpr double kPatchRadius = 17;        // px of a feature's level, what ORB looks at

/// The part of the plane z = 1 of the common view that a camera surely sees.
struct View {
  double left = -std::numeric_limits<double>::infinity();
  double right = std::numeric_limits<double>::infinity();
  double top = left;
  double bottom = right;
};

bool is_fisheye(const PinholeCamera& model) {
  return model.lens != LensModel::kRadialTangential;
}

/// Where the common view has a pixel of a camera; nothing for one that a fisheye sees far aside.
std::optional<Eigen::Vector2d> through(const PinholeCamera& model,
                                       const Eigen::Matrix3d& R_common_cam,
                                       const Eigen::Vector2d& pixel, const std::string& what) {
  const Eigen::Vector3d ray = model.unproject(pixel);
  if (is_fisheye(model) && ray.head<2>().norm() > 2 * kWidestView) return std::nullopt;
  if (!((model.project(ray) - pixel).norm() < kLensTolerance)) {
    fail("{}: expected a distortion that is monotonic in the image", what);
  }
  const Eigen::Vector3d turned = R_common_cam * ray;
  if (turned.z() < 0.1 * turned.norm()) {
    fail("{}: expected cameras that look roughly the same way", what);
  }
  return Eigen::Vector2d(turned.head<2>() / turned.z());
}

/// Narrows a view to what lies within the camera's image.
void narrow(View& view, const PinholeCamera& model, const Eigen::Matrix3d& R_common_cam,
            const std::string& what) {
  const double width = model.width - 1;
  const double height = model.height - 1;
  for (int i = 0; i < kBorderSamples; ++i) {
    const double share = static_cast<double>(i) / (kBorderSamples - 1);
    const auto at = [&](double x, double y) { return through(model, R_common_cam, {x, y}, what); };
    if (const auto p = at(0, share * height)) view.left = std::max(view.left, p->x());
    if (const auto p = at(width, share * height)) view.right = std::min(view.right, p->x());
    if (const auto p = at(share * width, 0)) view.top = std::max(view.top, p->y());
    if (const auto p = at(share * width, height)) view.bottom = std::min(view.bottom, p->y());
  }
}

void limit(View& view, double most) {
  view.left = std::max(view.left, -most);
  view.right = std::min(view.right, most);
  view.top = std::max(view.top, -most);
  view.bottom = std::min(view.bottom, most);
}

/// Squared distance from the axis, on the plane z = 1, of the farthest corner that is used.
double corner_radius(const PinholeCamera& model) {
  double most = 0;
  for (const double x : {0.0, model.width - 1.0}) {
    for (const double y : {0.0, model.height - 1.0}) {
      most = std::max(most, model.unproject({x, y}).head<2>().squaredNorm());
      if (is_fisheye(model)) most = std::min(most, 4 * kWidestView * kWidestView);
    }
  }
  return most;
}

}  // namespace

Rectification::Rectification(const RigCamera& left, const RigCamera& right,
                             const std::string& what) {
  choose_view(left, right, what);
  choose_lens(what);
  const cv::Mat seen = fill_maps(cameras_[0]);
  fill_maps(cameras_[1]);
  if (cv::countNonZero(seen) < seen.rows * seen.cols) {
    cv::distanceTransform(seen, clearance_, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  }
}

void Rectification::choose_view(const RigCamera& left, const RigCamera& right,
                                const std::string& what) {
  const Pose T_left_right = left.T_body_cam.inverse() * right.T_body_cam;
  const Eigen::Matrix3d R_left_right = T_left_right.rotation.toRotationMatrix();
  baseline_ = T_left_right.translation.norm();
  if (baseline_ < kMinBaseline) fail("{}: expected two cameras at different places", what);
  const Eigen::Vector3d x = T_left_right.translation / baseline_;
  const Eigen::Vector3d ahead = Eigen::Vector3d::UnitZ() + R_left_right.col(2);
  const Eigen::Vector3d z = (ahead - ahead.dot(x) * x).normalized();
  Eigen::Matrix3d R_left_common;
  R_left_common << x, z.cross(x), z;
  const Eigen::Matrix3d R_right_common = R_left_right.transpose() * R_left_common;
  for (const Eigen::Matrix3d& R : {R_left_common, R_right_common}) {
    if (R.diagonal().minCoeff() < kMinAlignment) {
      fail(
          "{}: expected the right camera to the right of the left camera, looking roughly the same "
          "way",
          what);
    }
  }
  cameras_[0] = {left.model, R_left_common, {}, {}};
  cameras_[1] = {right.model, R_right_common, {}, {}};
  T_body_left_ = {(left.T_body_cam.rotation * Eigen::Quaterniond(R_left_common)).normalized(),
                  left.T_body_cam.translation};
}

void Rectification::choose_lens(const std::string& what) {
  View view;
  double focal = 0;
  for (const Camera& camera : cameras_) {
    if (is_fisheye(camera.model)) limit(view, kWidestView);
    narrow(view, camera.model, camera.R_cam_common.transpose(), what);
    const PinholeCamera pinhole = camera.model.without_distortion();
    focal += (pinhole.fx + pinhole.fy) / 4;
  }
  lens_.width = cameras_[0].model.width;
  lens_.height = cameras_[0].model.height;
  const double across = view.right - view.left;
  const double down = view.bottom - view.top;
  if (across <= 0 || down <= 0) fail("{}: expected cameras that see the same scene", what);
  const double filling = std::max((lens_.width - 1) / across, (lens_.height - 1) / down);
  lens_.fx = lens_.fy = std::min(focal, filling);
  lens_.cx = (lens_.width - 1) / 2.0 - lens_.fx * (view.left + view.right) / 2;
  lens_.cy = (lens_.height - 1) / 2.0 - lens_.fy * (view.top + view.bottom) / 2;
}

/// Returns which pixels have a source (255, else 0).
cv::Mat Rectification::fill_maps(Camera& camera) const {
  cv::Mat x(lens_.height, lens_.width, CV_32FC1, cv::Scalar(kNowhere));
  cv::Mat y(lens_.height, lens_.width, CV_32FC1, cv::Scalar(kNowhere));
  cv::Mat seen(lens_.height, lens_.width, CV_8UC1, cv::Scalar(0));
  // Beyond the image's corners a lens model may fold back into it.
  const double most = kRadiusTolerance * corner_radius(camera.model);
  for (int row = 0; row < lens_.height; ++row) {
    for (int column = 0; column < lens_.width; ++column) {
      const Eigen::Vector3d ray =
          camera.R_cam_common * lens_.unproject(Eigen::Vector2d(column, row));
      if (ray.z() <= 0 || ray.head<2>().squaredNorm() > most * ray.z() * ray.z()) continue;
      const Eigen::Vector2d source = camera.model.project(ray);
      x.at<float>(row, column) = static_cast<float>(source.x());
      y.at<float>(row, column) = static_cast<float>(source.y());
      if (camera.model.contains(source)) seen.at<std::uint8_t>(row, column) = 255;
    }
  }
  cv::convertMaps(x, y, camera.whole, camera.fraction, CV_16SC2);
  return seen;
}

Eigen::Vector2d Rectification::in_left_image(const Eigen::Vector2d& pixel) const {
  return cameras_[0].model.project(cameras_[0].R_cam_common * lens_.unproject(pixel));
}

cv::Mat Rectification::Camera::remapped(const cv::Mat& grey) const {
  cv::Mat result;
  // The border's greys go on outside, so that no edge appears there.
  cv::remap(grey, result, whole, fraction, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return result;
}

void Rectification::drop_unseen(Features& features, const OrbExtractor& extractor) const {
  if (clearance_.empty()) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < features.size(); ++i) {
    const Keypoint& keypoint = features.keypoints[i];
    const int x = std::clamp(static_cast<int>(std::lround(keypoint.x)), 0, clearance_.cols - 1);
    const int y = std::clamp(static_cast<int>(std::lround(keypoint.y)), 0, clearance_.rows - 1);
    const double reach = kPatchRadius * extractor.scale_of(keypoint.level);
    if (static_cast<double>(clearance_.at<float>(y, x)) < reach) continue;
    features.keypoints[kept] = keypoint;
    features.descriptors[kept] = features.descriptors[i];
    ++kept;
  }
  features.keypoints.resize(kept);
  features.descriptors.resize(kept);
}

}  // namespace vinebench::slam
