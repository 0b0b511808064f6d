// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/geometry/pose.h"
#include "slam/camera/stereo_camera.h"
#include "slam/factors/calibration_belief.h"

namespace vinebench::slam {

/// What is seen of a point: a pixel, and where the right camera saw it too, its column there.
struct PixelMeasurement {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  std::optional<double> right_x;
  double sigma = 1;        ///< px
  double right_sigma = 1;  ///< px, of the column in the right camera
  /// Errors beyond the 95 % of this many times the standard deviation are outliers.
  double tolerance = 1;
  /// Of the body in its own frame (m/s, rad/s), of which a camera with times of its own makes use.
  Vector6d velocity = Vector6d::Zero();
  double late = 0;  ///< s after the frame's stamp that the image was taken, by its own stamp
  int size() const { return right_x ? 3 : 2; }
};

/// Reprojection error of one map point in one camera, Eq. (2), (3) and (5): residuals in standard
/// deviations, two for the pixel, a third for the column in the right camera. The same error serves
/// tracking, motion-only, local and global bundle adjustment.
///
/// An image with a stamp of its own, or a camera that exposes a row later than the frame's stamp
/// sees it from where the body's velocity has carried it by then.
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
    Eigen::Matrix3d by_point_in_body;         ///< by the point in the body frame
    Eigen::Matrix<double, 3, 6> by_velocity;  ///< unset where late() is 0
  };
  Linearised linearise(const Pose& T_map_body, const Eigen::Vector3d& p_map) const;

  /// The residuals alone.
  Eigen::Vector3d residual(const Pose& T_map_body, const Eigen::Vector3d& p_map) const {
    return residual_at(in_camera(in_body(T_map_body, p_map)));
  }

  /// Derivatives by the camera's calibration: the step of T_body_cam (camera frame: m, then rad),
  /// then the other numbers of PairCalibration in their order, about `nominal`, of which the
  /// shares are.
  Eigen::Matrix<double, 3, kPairUnknowns> by_calibration(const Pose& T_map_body,
                                                         const Eigen::Vector3d& p_map,
                                                         const StereoCameraModel& nominal) const;

  /// Squared norm of the residuals for that pose and point; infinite behind the camera.
  double chi_squared(const Pose& T_map_body, const Eigen::Vector3d& p_map) const;

  int size() const { return measurement_.size(); }

  /// s after the frame's stamp that the pixel's row was exposed.
  double late() const { return measurement_.late + camera_->time_of(measurement_.pixel.y()); }

 private:
  /// Where the point is from the body as it was when the row was exposed.
  Eigen::Vector3d in_body(const Pose& T_map_body, const Eigen::Vector3d& p_map) const {
    const Eigen::Vector3d p_body =
        T_map_body.rotation.conjugate() * (p_map - T_map_body.translation);
    return has_times() ? way_until_exposed().inverse() * p_body : p_body;
  }
  bool has_times() const { return camera_->has_times() || measurement_.late != 0; }
  Pose way_until_exposed() const { return step_of(measurement_.velocity * late()); }
  Eigen::Vector3d in_camera(const Eigen::Vector3d& p_body) const;
  Eigen::Vector3d residual_at(const Eigen::Vector3d& p_cam) const;
  Eigen::Vector3d weights() const;

  const StereoCameraModel* camera_;
  PixelMeasurement measurement_;
};

/// 95 % of the chi-square distribution with two and three degrees of freedom.
inline constexpr double kChiSquared2 = 5.991;
inline constexpr double kChiSquared3 = 7.815;

inline double chi_squared_limit(const PixelMeasurement& measurement) {
  const double limit = measurement.right_x ? kChiSquared3 : kChiSquared2;
  return limit * measurement.tolerance * measurement.tolerance;
}

}  // namespace vinebench::slam
