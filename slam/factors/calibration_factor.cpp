// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/factors/calibration_factor.h"

#include <Eigen/Cholesky>

#include "slam/factors/pose_manifold.h"
#include "slam/factors/projection_jacobian.h"

namespace vinebench::slam {

CalibrationFactor::CalibrationFactor(std::vector<Pose> T_body_nominal,
                                     const CalibrationBelief& belief)
    : T_body_nominal_(std::move(T_body_nominal)),
      root_(belief.information.llt().matrixU()),
      mean_(belief.mean()) {
  set_num_residuals(static_cast<int>(mean_.size()));
  for (std::size_t v = 0; v < T_body_nominal_.size(); ++v) {
    mutable_parameter_block_sizes()->push_back(7);
    mutable_parameter_block_sizes()->push_back(kLensUnknowns);
  }
  for (Eigen::Index at = begin_of_times(); at < mean_.size(); ++at) {
    mutable_parameter_block_sizes()->push_back(1);
  }
}

bool CalibrationFactor::Evaluate(double const* const* parameters, double* residuals,
                                 double** jacobians) const {
  Eigen::VectorXd unknowns(mean_.size());
  for (std::size_t v = 0; v < T_body_nominal_.size(); ++v) {
    const Pose off = T_body_nominal_[v].inverse() * from_block(parameters[2 * v]);
    unknowns.segment<kPairUnknowns>(kPairUnknowns * static_cast<Eigen::Index>(v))
        << off.translation,
        log_so3(off.rotation),
        Eigen::Map<const Eigen::Matrix<double, kLensUnknowns, 1>>(parameters[2 * v + 1]);
  }
  double const* const* times = parameters + 2 * T_body_nominal_.size();
  for (Eigen::Index at = begin_of_times(); at < mean_.size(); ++at) unknowns[at] = **times++;
  Eigen::Map<Eigen::VectorXd>(residuals, mean_.size()) = root_ * (unknowns - mean_);
  if (jacobians == nullptr) return true;
  for (std::size_t v = 0; v < T_body_nominal_.size(); ++v) {
    const Eigen::Index at = kPairUnknowns * static_cast<Eigen::Index>(v);
    if (jacobians[2 * v] != nullptr) {
      // A step turns the translation with the camera; of the rotation vector this is the first
      // order of the inverse right Jacobian, good to its square: 1e-5 of a step at half a degree.
      const Eigen::Vector3d turn = unknowns.segment<3>(at + 3);
      Matrix6d by_step = Matrix6d::Zero();
      by_step.topLeftCorner<3, 3>() = exp_so3(turn).toRotationMatrix();
      by_step.bottomRightCorner<3, 3>() = Eigen::Matrix3d::Identity() + 0.5 * cross_matrix(turn);
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor>> J(jacobians[2 * v],
                                                                              mean_.size(), 7);
      J.setZero();
      J.leftCols<6>() = root_.middleCols<6>(at) * by_step;
    }
    if (jacobians[2 * v + 1] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, kLensUnknowns, Eigen::RowMajor>> J(
          jacobians[2 * v + 1], mean_.size(), kLensUnknowns);
      J = root_.middleCols<kLensUnknowns>(at + 6);
    }
  }
  double** by_time = jacobians + 2 * T_body_nominal_.size();
  for (Eigen::Index at = begin_of_times(); at < mean_.size(); ++at, ++by_time) {
    if (*by_time != nullptr) Eigen::Map<Eigen::VectorXd>(*by_time, mean_.size()) = root_.col(at);
  }
  return true;
}

}  // namespace vinebench::slam
