// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/factors/tag_corner_factor.h"

#include <algorithm>

#include "slam/factors/pose_manifold.h"
#include "slam/factors/projection_jacobian.h"

namespace vinebench::slam {
namespace {

using RowMajor37 = Eigen::Matrix<double, 3, 7, Eigen::RowMajor>;

}  // namespace

TagCornerFactor::TagCornerFactor(const StereoCameraModel& camera, const Eigen::Vector2d& pixel,
                                 double sigma, const Eigen::Vector3d& p_tag)
    : camera_(&camera), pixel_(pixel), sigma_(sigma), p_tag_(p_tag) {
  set_num_residuals(2);
  *mutable_parameter_block_sizes() = {7, 7};
}

bool TagCornerFactor::Evaluate(double const* const* parameters, double* residuals,
                               double** jacobians) const {
  const Pose T_map_body = from_block(parameters[0]);
  const Pose T_map_tag = from_block(parameters[1]);
  const Eigen::Vector3d p_body = T_map_body.inverse() * (T_map_tag * p_tag_);
  Eigen::Vector3d p_cam = camera_->T_cam_body * p_body;
  p_cam.z() = std::max(p_cam.z(), kMinDepth);
  const Eigen::Vector2d r = (camera_->lens.project(p_cam) - pixel_) / sigma_;
  std::copy_n(r.data(), 2, residuals);
  if (jacobians == nullptr) return true;

  // The corners of distorted images are undistorted before they come here, so that the pinhole's
  // own Jacobian is exact.
  const Eigen::Matrix3d J_body = projection_jacobian(*camera_, p_cam) *
                                 camera_->T_cam_body.rotation.toRotationMatrix() / sigma_;
  if (jacobians[0] != nullptr) {
    RowMajor37 J = RowMajor37::Zero();
    J.leftCols<6>() = J_body * body_point_jacobian(p_body);
    copy_rows(J, 2, jacobians[0]);
  }
  if (jacobians[1] != nullptr) {
    const Eigen::Matrix3d R_body_tag =
        (T_map_body.rotation.conjugate() * T_map_tag.rotation).toRotationMatrix();
    RowMajor37 J = RowMajor37::Zero();
    J.leftCols<3>() = J_body * R_body_tag;
    J.middleCols<3>(3) = -J_body * R_body_tag * cross_matrix(p_tag_);
    copy_rows(J, 2, jacobians[1]);
  }
  return true;
}

}  // namespace vinebench::slam
