// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "core/geometry/cross_matrix.h"
#include "slam/camera/stereo_camera.h"

namespace vinebench::slam {

/// Nearer than this the projection says nothing.
inline constexpr double kMinDepth = 0.02;  // m

/// Derivative of StereoCameraModel::disparity_error by the right column, px per px: `right` and
/// `down` are slopes of the ray, `disparity` in px.
inline double error_by_right_ray(const StereoCameraModel& camera, double right, double down,
                                 double disparity) {
  return camera.disparity_slope + camera.right_turn.x() * down - 2 * camera.right_turn.y() * right +
         camera.right_ahead * disparity / camera.lens.fx;
}

/// Rows: d(u, v, u_right) / d(p_cam), px per m.
inline Eigen::Matrix3d projection_jacobian(const StereoCameraModel& camera,
                                           const Eigen::Vector3d& p) {
  const double inv_z = 1.0 / p.z();
  const double fx_z = camera.lens.fx * inv_z;
  const double fy_z = camera.lens.fy * inv_z;
  Eigen::Matrix3d J;
  J << fx_z, 0, -fx_z * p.x() * inv_z,  //
      0, fy_z, -fy_z * p.y() * inv_z,   //
      fx_z, 0, -fx_z * (p.x() - camera.baseline) * inv_z;
  if (!camera.has_disparity_errors()) return J;
  const double disparity = fx_z * camera.baseline;
  const double right = (p.x() - camera.baseline) * inv_z;
  const double down = p.y() * inv_z;
  const Eigen::RowVector3d by_disparity = J.row(0) - J.row(2);
  J.row(2) += error_by_right_ray(camera, right, down, disparity) * J.row(2) +
              camera.right_ahead * right * by_disparity +
              (camera.right_turn.x() * right + camera.right_turn.z()) * camera.lens.fx /
                  camera.lens.fy * J.row(1);
  return J;
}

/// Derivative of a point in the body frame by the step of PoseManifold.
inline Eigen::Matrix<double, 3, 6> body_point_jacobian(const Eigen::Vector3d& p_body) {
  Eigen::Matrix<double, 3, 6> J;
  J << -Eigen::Matrix3d::Identity(), cross_matrix(p_body);
  return J;
}

/// The first rows of a Jacobian as Ceres wants them: row by row.
template <class Jacobian>
void copy_rows(const Jacobian& source, int rows, double* target) {
  const int columns = static_cast<int>(source.cols());
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) target[r * columns + c] = source(r, c);
  }
}

}  // namespace vinebench::slam
