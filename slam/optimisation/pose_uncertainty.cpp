// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/pose_uncertainty.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "core/geometry/step_covariance.h"

namespace vinebench::slam {
namespace {

Matrix6d inflated_inverse(const Matrix6d& information) {
  const Eigen::LDLT<Matrix6d> solver(information);
  const bool usable =
      solver.info() == Eigen::Success && solver.isPositive() && solver.vectorD().minCoeff() > 0;
  if (!usable) return Matrix6d::Zero();
  return PoseUncertainty::kInflation * solver.solve(Matrix6d::Identity());
}

}  // namespace

void PoseUncertainty::start(const Matrix6d& covariance) {
  known_ = of_start(covariance);
  by_calibration_.resize(6, 0);
  without_drift_ = 0;
}

void PoseUncertainty::keyframe(const Pose& T_last_now, const Matrix6d& information,
                               const Eigen::MatrixXd& drift) {
  known_ = moved(T_last_now);
  known_.topLeftCorner<6, 6>() += inflated_inverse(information);
  const double alike = std::exp(-T_last_now.translation.norm() / kAlike);
  known_.topRightCorner<6, kRates>() *= alike;
  known_.bottomLeftCorner<kRates, 6>() *= alike;
  known_.bottomRightCorner<kRates, kRates>() *= alike * alike;
  known_.bottomRightCorner<kRates, kRates>().diagonal().array() += 1 - alike * alike;
  if (by_calibration_.cols() != drift.cols()) by_calibration_.setZero(6, drift.cols());
  by_calibration_ = carried_step(T_last_now) * by_calibration_ + drift;
  if (drift.isZero()) {
    ++without_drift_;
  } else if (without_drift_ > 0) {
    by_calibration_ += without_drift_ * drift;
    without_drift_ = 0;
  }
}

void PoseUncertainty::measure(const Matrix6d& covariance) {
  const Matrix6d innovation = known_.topLeftCorner<6, 6>() + covariance;
  const Eigen::Matrix<double, 6 + kRates, 6> gain =
      known_.leftCols<6>() * innovation.ldlt().solve(Matrix6d::Identity());
  Covariance left = Covariance::Identity();
  left.leftCols<6>() -= gain;
  known_ = left * known_ * left.transpose() + gain * covariance * gain.transpose();
  by_calibration_ = left.topLeftCorner<6, 6>() * by_calibration_;
}

void PoseUncertainty::cross_gap(const Pose& T_last_now, const Matrix6d& covariance) {
  const Matrix6d carried = carried_step(T_last_now);
  known_.topRows<6>() = (carried * known_.topRows<6>()).eval();
  known_.leftCols<6>() = (known_.leftCols<6>() * carried.transpose()).eval();
  known_.topLeftCorner<6, 6>() += covariance;
  by_calibration_ = carried * by_calibration_;
}

Matrix6d PoseUncertainty::of_calibration(const Pose& T_last_now, const Eigen::MatrixXd& error,
                                         const Eigen::MatrixXd& of_frame) const {
  Eigen::MatrixXd now = Eigen::MatrixXd::Zero(6, error.cols());
  if (by_calibration_.cols() == error.cols()) now = carried_step(T_last_now) * by_calibration_;
  if (of_frame.cols() == error.cols()) now += of_frame;
  return now * error * now.transpose();
}

Matrix6d PoseUncertainty::at(const Pose& T_last_now, const Matrix6d& information) const {
  return moved(T_last_now).topLeftCorner<6, 6>() + inflated_inverse(information);
}

PoseUncertainty::Covariance PoseUncertainty::of_start(const Matrix6d& covariance) {
  Covariance start = Covariance::Identity();
  start.topLeftCorner<6, 6>() = covariance;
  return start;
}

PoseUncertainty::Covariance PoseUncertainty::moved(const Pose& T_last_now) const {
  Covariance by_state = Covariance::Identity();
  by_state.topLeftCorner<6, 6>() = carried_step(T_last_now);
  const Eigen::Vector3d& way = T_last_now.translation;
  by_state.block<3, 1>(0, 6) = kScale * way;
  for (int axis = 0; axis < 3; ++axis) {
    by_state.block<1, 3>(3 + axis, 7 + 3 * axis) = kTurn * way.transpose();
  }
  return by_state * known_ * by_state.transpose();
}

}  // namespace vinebench::slam
