// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/ceres.h>

#include <array>
#include <optional>

#include "core/geometry/camera.h"
#include "core/geometry/pose.h"

namespace vinebench::slam {

/// A pose T_map_body as Ceres holds it: qx qy qz qw, x y z.
using PoseBlock = std::array<double, 7>;

PoseBlock to_block(const Pose& pose);
Pose from_block(const double* block);

/// Steps a pose in the body's own frame: T * step_of(step). Cost functions give their Jacobian for
/// that step in the first six columns of the block and zero in the seventh, which the plus-Jacobian
/// of this manifold takes over as they are.
class PoseManifold : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return 6; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;
};

/// A camera on the body: its lens and where it sits; `baseline` is the right camera's distance
/// along the camera's x axis, m.
struct StereoCameraModel {
  PinholeCamera lens;
  Pose T_cam_body;
  double baseline = 0;
  double disparity_offset =
      0;  ///< px that disparities measure too little, by the pair's calibration

  /// m along the optical axis, of a measured disparity (px).
  double depth_of(double disparity) const {
    return lens.fx * baseline / (disparity + disparity_offset);
  }
  /// px that a point in that depth (m) is measured at.
  double disparity_of(double depth) const { return lens.fx * baseline / depth - disparity_offset; }
};

/// What is seen of a point: a pixel, and where the right camera saw it too, its column there.
struct PixelMeasurement {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  std::optional<double> right_x;
  double sigma = 1;        ///< px
  double right_sigma = 1;  ///< px, of the column in the right camera
  /// Errors beyond the 95 % of this many times the standard deviation are outliers.
  double tolerance = 1;
  int size() const { return right_x ? 3 : 2; }
};

/// Reprojection error of one map point in one camera, Eq. (2), (3) and (5): residuals in standard
/// deviations, two for the pixel, a third for the column in the right camera. The same error serves
/// tracking, motion-only, local and global bundle adjustment.
class Reprojection {
 public:
  /// Keeps a pointer to the camera.
  Reprojection(const StereoCameraModel& camera, const PixelMeasurement& measurement)
      : camera_(&camera), measurement_(measurement) {}

  /// Residuals (zero where there is no third) and their derivatives by the step of PoseManifold,
  /// for a point in the map.
  struct Linearised {
    Eigen::Vector3d residual;
    Eigen::Matrix<double, 3, 6> by_pose;
    Eigen::Matrix3d by_point_in_body;  ///< by the point in the body frame
  };
  Linearised linearise(const Pose& T_map_body, const Eigen::Vector3d& p_map) const {
    return linearise(T_map_body, p_map, camera_->disparity_offset);
  }

  /// The same for another disparity offset than the camera's (px).
  Linearised linearise(const Pose& T_map_body, const Eigen::Vector3d& p_map,
                       double disparity_offset) const;

  /// The residuals alone.
  Eigen::Vector3d residual(const Pose& T_map_body, const Eigen::Vector3d& p_map) const {
    return residual(T_map_body, p_map, camera_->disparity_offset);
  }
  Eigen::Vector3d residual(const Pose& T_map_body, const Eigen::Vector3d& p_map,
                           double disparity_offset) const {
    return residual_at(in_camera(in_body(T_map_body, p_map)), disparity_offset);
  }

  /// Derivative of the third residual by the disparity offset, 1/px.
  double by_disparity_offset() const { return 1 / measurement_.right_sigma; }

  /// Squared norm of the residuals for that pose and point; infinite behind the camera.
  double chi_squared(const Pose& T_map_body, const Eigen::Vector3d& p_map) const;

  int size() const { return measurement_.size(); }
  const StereoCameraModel& camera() const { return *camera_; }

 private:
  static Eigen::Vector3d in_body(const Pose& T_map_body, const Eigen::Vector3d& p_map) {
    return T_map_body.rotation.conjugate() * (p_map - T_map_body.translation);
  }
  Eigen::Vector3d in_camera(const Eigen::Vector3d& p_body) const;
  Eigen::Vector3d residual_at(const Eigen::Vector3d& p_cam, double disparity_offset) const;

  const StereoCameraModel* camera_;
  PixelMeasurement measurement_;
};

/// The same as a cost function of Ceres: parameters are the body's pose (7), the point (3) and,
/// where it is an unknown, the camera's disparity offset (1), which the right camera alone
/// measures.
class ReprojectionError : public ceres::CostFunction {
 public:
  ReprojectionError(const StereoCameraModel& camera, const PixelMeasurement& measurement,
                    bool offset_unknown = false);

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

  double chi_squared(const Pose& T_map_body, const Eigen::Vector3d& p_map) const {
    return reprojection_.chi_squared(T_map_body, p_map);
  }

 private:
  Reprojection reprojection_;
};

/// Reprojection error of a tag's corner: parameters are the body's pose (7) and the tag's (7).
class TagCornerError : public ceres::CostFunction {
 public:
  TagCornerError(const StereoCameraModel& camera, const Eigen::Vector2d& pixel, double sigma,
                 const Eigen::Vector3d& p_tag);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  const StereoCameraModel* camera_;
  Eigen::Vector2d pixel_;
  double sigma_;
  Eigen::Vector3d p_tag_;
};

/// How two keyframes' poses differ from what dead reckoning measured between them, in standard
/// deviations: parameters are the poses of the earlier and the later (7 each). The Jacobians take
/// the rotation's difference to be small.
class OdometryError : public ceres::SizedCostFunction<6, 7, 7> {
 public:
  OdometryError(const Pose& T_from_to, const Matrix6d& covariance);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  Pose T_from_to_;
  Matrix6d weight_;  ///< W with W^T W the inverse covariance
};

/// 95 % of the chi-square distribution with two and three degrees of freedom.
inline constexpr double kChiSquared2 = 5.991;
inline constexpr double kChiSquared3 = 7.815;

inline double chi_squared_limit(const PixelMeasurement& measurement) {
  const double limit = measurement.right_x ? kChiSquared3 : kChiSquared2;
  return limit * measurement.tolerance * measurement.tolerance;
}

/// Loss of a reprojection error near the solution, in standard deviations. The errors of patches
/// have long tails, since some straddle a stem and the ground behind it, and those tails point one
/// way: what lies behind moves less. Huber's loss, which the paper uses, lets each of them pull as
/// hard as a good one; this one lets go of them.
inline constexpr double kCauchyScale = 1;

}  // namespace vinebench::slam
