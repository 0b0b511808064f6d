// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/factors/relative_pose_factor.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "slam/factors/pose_manifold.h"
#include "slam/factors/projection_jacobian.h"

namespace vinebench::slam {

RelativePoseFactor::RelativePoseFactor(const Pose& T_from_to, const Matrix6d& covariance)
    : T_from_to_(T_from_to), weight_(covariance.inverse().llt().matrixU()) {}

bool RelativePoseFactor::Evaluate(double const* const* parameters, double* residuals,
                                  double** jacobians) const {
  const Pose T_from_to = from_block(parameters[0]).inverse() * from_block(parameters[1]);
  const Pose error = T_from_to_.inverse() * T_from_to;
  Vector6d r;
  r << error.translation, log_so3(error.rotation);
  Eigen::Map<Vector6d> weighted(residuals);
  weighted = weight_ * r;
  if (jacobians == nullptr) return true;
  using RowMajor67 = Eigen::Matrix<double, 6, 7, Eigen::RowMajor>;
  if (jacobians[0] != nullptr) {
    // The earlier pose's step seen from the later end, the other way about.
    const Eigen::Matrix3d R_measured = T_from_to_.rotation.toRotationMatrix().transpose();
    Matrix6d J = Matrix6d::Zero();
    J.topLeftCorner<3, 3>() = -R_measured;
    J.topRightCorner<3, 3>() = R_measured * cross_matrix(T_from_to.translation);
    J.bottomRightCorner<3, 3>() = -T_from_to.rotation.toRotationMatrix().transpose();
    Eigen::Map<RowMajor67> block(jacobians[0]);
    block.setZero();
    block.leftCols<6>() = weight_ * J;
  }
  if (jacobians[1] != nullptr) {
    Matrix6d J = Matrix6d::Identity();
    J.topLeftCorner<3, 3>() = error.rotation.toRotationMatrix();
    Eigen::Map<RowMajor67> block(jacobians[1]);
    block.setZero();
    block.leftCols<6>() = weight_ * J;
  }
  return true;
}

}  // namespace vinebench::slam
