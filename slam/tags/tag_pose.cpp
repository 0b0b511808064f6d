// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tags/tag_pose.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <utility>
#include <vector>

namespace vinebench::slam {
namespace {

using Points3 = std::array<Eigen::Vector3d, 4>;
using Points2 = std::array<Eigen::Vector2d, 4>;

constexpr int kMaxSteps = 20;
constexpr double kConverged = 1e-12;  ///< rad and m

/// Poses nearer to each other than this are one pose and its uncertainty.
constexpr double kOtherPose = 0.15;  // rad
/// A difference of squared errors, in variances, that makes one pose a thousand times likelier than
/// the other: 2 ln 1000. Also 99.9 % of the chi-square distribution with two degrees of freedom,
/// which is what four corners have over a pose.
constexpr double kThousandfold = 13.8;
/// By which corners are off besides their noise: bent edges, a bent print.
constexpr double kBent = 0.3;  // px

/// Corners in the tag frame, in the order of TagSighting::corners.
Points3 tag_corners(double size) {
  const double h = size / 2;
  return {Eigen::Vector3d(-h, h, 0), Eigen::Vector3d(h, h, 0), Eigen::Vector3d(h, -h, 0),
          Eigen::Vector3d(-h, -h, 0)};
}

/// Sum of squared reprojection errors on the plane z = 1; infinite behind the
/// camera.
double reprojection_error(const Pose& T_cam_tag, const Points3& corners, const Points2& seen) {
  double error = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d p = T_cam_tag * corners[i];
    if (p.z() <= 0) return std::numeric_limits<double>::infinity();
    error += (p.head<2>() / p.z() - seen[i]).squaredNorm();
  }
  return error;
}

/// One Levenberg-Marquardt step; the perturbation turns and moves the tag in the camera frame.
Pose step(const Pose& T_cam_tag, const Points3& corners, const Points2& seen, double damping,
          double& size_of_step) {
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Vector6d gradient = Vector6d::Zero();
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d turned = T_cam_tag.rotation * corners[i];
    const Eigen::Vector3d p = turned + T_cam_tag.translation;
    const Eigen::Vector2d plane = p.head<2>() / p.z();
    Eigen::Matrix<double, 2, 3> by_point;
    by_point << 1, 0, -plane.x(), 0, 1, -plane.y();
    by_point /= p.z();
    Eigen::Matrix<double, 3, 6> by_pose;
    by_pose << 0, turned.z(), -turned.y(), 1, 0, 0,  //
        -turned.z(), 0, turned.x(), 0, 1, 0,         //
        turned.y(), -turned.x(), 0, 0, 0, 1;
    const Eigen::Matrix<double, 2, 6> jacobian = by_point * by_pose;
    normal += jacobian.transpose() * jacobian;
    gradient += jacobian.transpose() * (plane - seen[i]);
  }
  normal.diagonal() *= 1 + damping;
  const Vector6d delta = normal.ldlt().solve(gradient);
  size_of_step = delta.norm();
  return {(exp_so3(-delta.head<3>()) * T_cam_tag.rotation).normalized(),
          T_cam_tag.translation - delta.tail<3>()};
}

Pose refine(Pose pose, const Points3& corners, const Points2& seen) {
  double error = reprojection_error(pose, corners, seen);
  double damping = 1e-6;
  for (int i = 0; i < kMaxSteps; ++i) {
    double moved = 0;
    const Pose next = step(pose, corners, seen, damping, moved);
    const double next_error = reprojection_error(next, corners, seen);
    if (next_error < error) {
      pose = next;
      error = next_error;
      damping *= 0.1;
    } else {
      damping *= 10;
    }
    if (moved < kConverged) break;
  }
  return pose;
}

bool is_square(double squared_error, double sigma) {
  return squared_error <= kThousandfold * (sigma * sigma + kBent * kBent);
}

/// The better pose's errors say too how large errors are: two degrees of freedom are left of eight.
bool is_as_likely(double squared_error, double least, double sigma) {
  return squared_error - least < kThousandfold * std::max(sigma * sigma, least / 2);
}

/// The two poses of the closed-form solution.
std::vector<Pose> solve_closed_form(const Points3& corners, const Points2& seen) {
  std::vector<cv::Point3d> object;
  std::vector<cv::Point2d> image;
  for (std::size_t i = 0; i < 4; ++i) {
    object.emplace_back(corners[i].x(), corners[i].y(), 0);
    image.emplace_back(seen[i].x(), seen[i].y());
  }
  std::vector<cv::Mat> rotations;
  std::vector<cv::Mat> translations;
  cv::solvePnPGeneric(object, image, cv::Matx33d::eye(), cv::noArray(), rotations, translations,
                      false, cv::SOLVEPNP_IPPE_SQUARE);
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    const double* r = rotations[i].ptr<double>();
    const double* t = translations[i].ptr<double>();
    poses.push_back({exp_so3({r[0], r[1], r[2]}), {t[0], t[1], t[2]}});
  }
  return poses;
}

}  // namespace

TagPose estimate_tag_pose(const std::array<Eigen::Vector2d, 4>& corners, const PinholeCamera& model,
                          double size, double corner_sigma) {
  const Points3 object = tag_corners(size);
  Points2 seen;
  for (std::size_t i = 0; i < 4; ++i) seen[i] = model.unproject(corners[i]).head<2>();
  std::vector<std::pair<double, Pose>> solutions;  // sum of squared errors, px^2
  for (const Pose& start : solve_closed_form(object, seen)) {
    const Pose pose = refine(start, object, seen);
    solutions.emplace_back(model.fx * model.fy * reprojection_error(pose, object, seen), pose);
  }
  std::ranges::stable_sort(solutions, {}, &std::pair<double, Pose>::first);
  TagPose result;
  result.square = !solutions.empty() && is_square(solutions[0].first, corner_sigma);
  if (solutions.empty()) return result;
  result.T_cam_tag = solutions[0].second;
  for (const auto& [error, pose] : solutions) {
    const bool other = angle_of(pose.rotation.conjugate() * result.T_cam_tag.rotation) > kOtherPose;
    result.ambiguous |= other && is_as_likely(error, solutions[0].first, corner_sigma);
  }
  return result;
}

}  // namespace vinebench::slam
