// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/step_covariance.h"

#include "core/geometry/cross_matrix.h"

namespace vinebench {

Matrix6d isotropic_covariance(double offset, double turn) {
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(offset * offset), Eigen::Vector3d::Constant(turn * turn);
  return variances.asDiagonal();
}

Matrix6d carried_step(const Pose& T_a_b) {
  // A step (rho, theta) of a moves b by R_ba (rho + theta x t) and turns it by R_ba theta.
  const Eigen::Matrix3d R_b_a = T_a_b.rotation.toRotationMatrix().transpose();
  Matrix6d J = Matrix6d::Zero();
  J.topLeftCorner<3, 3>() = R_b_a;
  J.topRightCorner<3, 3>() = -R_b_a * cross_matrix(T_a_b.translation);
  J.bottomRightCorner<3, 3>() = R_b_a;
  return J;
}

Matrix6d carry_covariance(const Matrix6d& of_a, const Pose& T_a_b) {
  const Matrix6d J = carried_step(T_a_b);
  return J * of_a * J.transpose();
}

}  // namespace vinebench
