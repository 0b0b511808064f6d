// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/factors/reprojection_factor.h"

#include <algorithm>

#include "slam/factors/pose_manifold.h"
#include "slam/factors/projection_jacobian.h"

namespace vinebench::slam {
namespace {

using RowMajor37 = Eigen::Matrix<double, 3, 7, Eigen::RowMajor>;

}  // namespace

ReprojectionFactor::ReprojectionFactor(const StereoCameraModel& camera,
                                       const PixelMeasurement& measurement, bool offset_unknown)
    : reprojection_(camera, measurement) {
  set_num_residuals(measurement.size());
  *mutable_parameter_block_sizes() = {7, 3};
  if (offset_unknown) mutable_parameter_block_sizes()->push_back(1);
}

bool ReprojectionFactor::Evaluate(double const* const* parameters, double* residuals,
                                  double** jacobians) const {
  const Pose T_map_body = from_block(parameters[0]);
  const Eigen::Map<const Eigen::Vector3d> p_map(parameters[1]);
  const bool offset_unknown = parameter_block_sizes().size() > 2;
  const double offset = offset_unknown ? parameters[2][0] : reprojection_.camera().disparity_offset;
  if (jacobians == nullptr) {
    const Eigen::Vector3d residual = reprojection_.residual(T_map_body, p_map, offset);
    std::copy_n(residual.data(), num_residuals(), residuals);
    return true;
  }
  const Reprojection::Linearised at = reprojection_.linearise(T_map_body, p_map, offset);
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
  if (offset_unknown && jacobians[2] != nullptr) {
    std::fill_n(jacobians[2], num_residuals(), 0.0);
    if (num_residuals() == 3) jacobians[2][2] = reprojection_.by_disparity_offset();
  }
  return true;
}

}  // namespace vinebench::slam
