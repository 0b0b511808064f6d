// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/factors/pose_manifold.h"

#include <algorithm>

namespace vinebench::slam {

PoseBlock to_block(const Pose& pose) {
  const Eigen::Quaterniond& q = pose.rotation;
  const Eigen::Vector3d& p = pose.translation;
  return {q.x(), q.y(), q.z(), q.w(), p.x(), p.y(), p.z()};
}

Pose from_block(const double* b) {
  return {Eigen::Quaterniond(b[3], b[0], b[1], b[2]).normalized(), {b[4], b[5], b[6]}};
}

bool PoseManifold::Plus(const double* x, const double* delta, double* x_plus_delta) const {
  const Pose stepped = from_block(x) * step_of(Eigen::Map<const Vector6d>(delta));
  std::ranges::copy(to_block(stepped), x_plus_delta);
  return true;
}

bool PoseManifold::PlusJacobian(const double*, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>> J(jacobian);
  J.setZero();
  J.topRows<6>().setIdentity();
  return true;
}

bool PoseManifold::Minus(const double* y, const double* x, double* y_minus_x) const {
  const Pose T_x_y = from_block(x).inverse() * from_block(y);
  Eigen::Map<Vector6d> difference(y_minus_x);
  difference << T_x_y.translation, log_so3(T_x_y.rotation);
  return true;
}

bool PoseManifold::MinusJacobian(const double*, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> J(jacobian);
  J.setZero();
  J.leftCols<6>().setIdentity();
  return true;
}

}  // namespace vinebench::slam
