// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/factors/reprojection_factor.h"

#include <algorithm>
#include <optional>

#include "slam/factors/calibration_belief.h"
#include "slam/factors/pose_manifold.h"
#include "slam/factors/projection_jacobian.h"

namespace vinebench::slam {
namespace {

using RowMajor37 = Eigen::Matrix<double, 3, 7, Eigen::RowMajor>;

}  // namespace

ReprojectionFactor::ReprojectionFactor(const StereoCameraModel& camera,
                                       const PixelMeasurement& measurement, Unknown unknown)
    : camera_(&camera), measurement_(measurement), unknown_(unknown) {
  set_num_residuals(measurement.size());
  *mutable_parameter_block_sizes() = {7, 3};
  if (unknown.calibration) *mutable_parameter_block_sizes() = {7, 3, 7, kLensUnknowns};
  if (unknown.velocity) mutable_parameter_block_sizes()->push_back(6);
}

StereoCameraModel ReprojectionFactor::camera_of(double const* const* parameters) const {
  const double* n = parameters[3];
  const PairCalibration lens{
      {}, n[0], n[1], n[2], n[3], n[4], n[5], {n[6], n[7]}, {n[8], n[9], n[10]}, n[11]};
  StereoCameraModel camera = calibrated(*camera_, lens);
  camera.T_cam_body = from_block(parameters[2]).inverse();
  return camera;
}

bool ReprojectionFactor::Evaluate(double const* const* parameters, double* residuals,
                                  double** jacobians) const {
  const Pose T_map_body = from_block(parameters[0]);
  const Eigen::Map<const Eigen::Vector3d> p_map(parameters[1]);
  const std::size_t velocity = unknown_.calibration ? 4 : 2;
  std::optional<StereoCameraModel> found;
  if (unknown_.calibration) found = camera_of(parameters);
  const StereoCameraModel& camera = found ? *found : *camera_;
  PixelMeasurement measurement = measurement_;
  if (unknown_.velocity) measurement.velocity = Eigen::Map<const Vector6d>(parameters[velocity]);
  const Reprojection reprojection(camera, measurement);
  if (jacobians == nullptr) {
    const Eigen::Vector3d residual = reprojection.residual(T_map_body, p_map);
    std::copy_n(residual.data(), num_residuals(), residuals);
    return true;
  }
  const Reprojection::Linearised at = reprojection.linearise(T_map_body, p_map);
  std::copy_n(at.residual.data(), num_residuals(), residuals);
  if (jacobians[0] != nullptr) {
    RowMajor37 J = RowMajor37::Zero();
    J.leftCols<6>() = at.by_pose;
    copy_rows(J, num_residuals(), jacobians[0]);
  }
  if (jacobians[1] != nullptr) {
    const Eigen::Matrix3d R_body_map = T_map_body.rotation.toRotationMatrix().transpose();
    copy_rows(Eigen::Matrix3d(at.by_point_in_body * R_body_map), num_residuals(), jacobians[1]);
  }
  if (unknown_.velocity && jacobians[velocity] != nullptr) {
    Eigen::Matrix<double, 3, 6> J = Eigen::Matrix<double, 3, 6>::Zero();
    if (reprojection.late() != 0) J = at.by_velocity;
    copy_rows(J, num_residuals(), jacobians[velocity]);
  }
  if (!unknown_.calibration) return true;
  if (jacobians[2] == nullptr && jacobians[3] == nullptr) return true;
  const auto by_calibration = reprojection.by_calibration(T_map_body, p_map, *camera_);
  if (jacobians[2] != nullptr) {
    RowMajor37 J = RowMajor37::Zero();
    J.leftCols<6>() = by_calibration.leftCols<6>();
    copy_rows(J, num_residuals(), jacobians[2]);
  }
  if (jacobians[3] != nullptr) {
    copy_rows(Eigen::Matrix<double, 3, kLensUnknowns>(by_calibration.rightCols<kLensUnknowns>()),
              num_residuals(), jacobians[3]);
  }
  return true;
}

}  // namespace vinebench::slam
