// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/factors/tag_measure_factor.h"

#include <algorithm>

#include "slam/factors/pose_manifold.h"
#include "slam/factors/projection_jacobian.h"

namespace vinebench::slam {
namespace {

using PoseRows = Eigen::Matrix<double, 3, 7, Eigen::RowMajor>;

}  // namespace

TagMeasureFactor::TagMeasureFactor(const StereoCameraModel& camera, const Eigen::Vector2d& pixel,
                                   double sigma, const Eigen::Vector3d& corner, int index,
                                   const Vector6d& velocity, double time)
    : camera_(&camera),
      pixel_(pixel),
      sigma_(sigma),
      corner_(corner),
      index_(index),
      velocity_(velocity),
      time_(time) {
  set_num_residuals(2);
  *mutable_parameter_block_sizes() = {7, 7, 7, 1, TagErrors::kNumbers};
}

bool TagMeasureFactor::Evaluate(double const* const* parameters, double* residuals,
                                double** jacobians) const {
  const Pose T_map_body = from_block(parameters[0]);
  const Pose T_map_tag = from_block(parameters[1]);
  const Pose T_body_cam = from_block(parameters[2]);
  const Pose T_body_then = step_of(velocity_ * (*parameters[3] - time_));
  const double* errors = parameters[4];
  const Eigen::Vector3d p_tag = (1 + errors[TagErrors::kSize]) * corner_;
  const Eigen::Vector3d p_body = T_map_body.inverse() * (T_map_tag * p_tag);
  const Eigen::Vector3d p_then = T_body_then.inverse() * p_body;
  Eigen::Vector3d p_cam = T_body_cam.inverse() * p_then;
  p_cam.z() = std::max(p_cam.z(), kMinDepth);
  const Eigen::Vector2d offset(errors[2 * index_], errors[2 * index_ + 1]);
  const Eigen::Vector2d r = (camera_->lens.project(p_cam) + offset - pixel_) / sigma_;
  std::copy_n(r.data(), 2, residuals);
  if (jacobians == nullptr) return true;

  const Eigen::Matrix3d J_cam = projection_jacobian(*camera_, p_cam) / sigma_;
  const Eigen::Matrix3d J_then = J_cam * T_body_cam.rotation.conjugate().toRotationMatrix();
  const Eigen::Matrix3d J_body = J_then * T_body_then.rotation.conjugate().toRotationMatrix();
  const Eigen::Matrix3d J_tag =
      J_body * (T_map_body.rotation.conjugate() * T_map_tag.rotation).toRotationMatrix();
  PoseRows J = PoseRows::Zero();
  if (jacobians[0] != nullptr) {
    J.leftCols<6>() = J_body * body_point_jacobian(p_body);
    copy_rows(J, 2, jacobians[0]);
  }
  if (jacobians[1] != nullptr) {
    J.leftCols<6>() = -J_tag * body_point_jacobian(p_tag);
    copy_rows(J, 2, jacobians[1]);
  }
  if (jacobians[2] != nullptr) {
    J.leftCols<6>() = J_cam * body_point_jacobian(p_cam);
    copy_rows(J, 2, jacobians[2]);
  }
  if (jacobians[3] != nullptr) {
    // The body's own motion, seen from it: its turn is about an axis that turns with it.
    const Eigen::Vector3d turn = velocity_.tail<3>();
    const Eigen::Vector3d by_time =
        -turn.cross(p_then) - T_body_then.rotation.conjugate() * velocity_.head<3>();
    const Eigen::Vector2d column = (J_then * by_time).head<2>();
    std::copy_n(column.data(), 2, jacobians[3]);
  }
  if (jacobians[4] != nullptr) {
    Eigen::Matrix<double, 2, TagErrors::kNumbers> by_errors;
    by_errors.setZero();
    by_errors.middleCols<2>(2 * index_) = Eigen::Matrix2d::Identity() / sigma_;
    by_errors.col(TagErrors::kSize) = (J_tag * corner_).head<2>();
    copy_rows(by_errors, 2, jacobians[4]);
  }
  return true;
}

}  // namespace vinebench::slam
