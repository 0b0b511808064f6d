// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/pose_uncertainty.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

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
  noise_ = covariance;
  by_way_.setZero();
  by_calibration_.resize(6, 0);
  without_drift_ = 0;
}

void PoseUncertainty::keyframe(const Pose& T_last_now, const Matrix6d& information,
                               const Eigen::MatrixXd& drift) {
  noise_ = noise_at(T_last_now, information);
  by_way_ = by_way_at(T_last_now);
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
  const Matrix6d before = noise_ + by_way_ * by_way_.transpose();
  const Matrix6d gain = before * (before + covariance).inverse();
  const Matrix6d left = Matrix6d::Identity() - gain;
  noise_ = left * noise_ * left.transpose() + gain * covariance * gain.transpose();
  by_way_ = left * by_way_;
  by_calibration_ = left * by_calibration_;
}

void PoseUncertainty::cross_gap(const Pose& T_last_now, const Matrix6d& covariance) {
  const Matrix6d carried = carried_step(T_last_now);
  noise_ = carry_covariance(noise_, T_last_now) + covariance;
  by_way_ = carried * by_way_;
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
  const ByWay by_way = by_way_at(T_last_now);
  return noise_at(T_last_now, information) + by_way * by_way.transpose();
}

Matrix6d PoseUncertainty::noise_at(const Pose& T_last_now, const Matrix6d& information) const {
  return carry_covariance(noise_, T_last_now) + inflated_inverse(information);
}

PoseUncertainty::ByWay PoseUncertainty::by_way_at(const Pose& T_last_now) const {
  return carried_step(T_last_now) * by_way_ + of_way(T_last_now.translation);
}

PoseUncertainty::ByWay PoseUncertainty::of_way(const Eigen::Vector3d& way) {
  ByWay steps = ByWay::Zero();
  steps.col(0).head<3>() = kScale * way;
  for (int axis = 0; axis < 3; ++axis) {
    steps.block<1, 3>(3 + axis, 1 + 3 * axis) = kTurn * way.transpose();
  }
  return steps;
}

}  // namespace vinebench::slam
