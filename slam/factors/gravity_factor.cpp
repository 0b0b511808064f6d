// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/factors/gravity_factor.h"

#include "core/geometry/cross_matrix.h"
#include "slam/factors/pose_manifold.h"

namespace vinebench::slam {

GravityFactor::GravityFactor(const PreintegratedMotion& before, const PreintegratedMotion& after,
                             double sigma)
    : before_(before.seconds),
      after_(after.seconds),
      weight_(2 / ((before_ + after_) * sigma)),
      gravity_(1 / sigma),
      first_{before.velocity - before.position / before_,
             before.velocity_by_bias - before.position_by_bias / before_,
             before.accelerometer_bias},
      second_{after.position / after_, after.position_by_bias / after_, after.accelerometer_bias} {}

Eigen::Vector3d GravityFactor::Difference::of(const Eigen::Vector3d& other) const {
  return at_bias + by_bias * (other - bias);
}

/// With p, R the poses, v the middle velocity, t and u the intervals, g gravity, a and b the
/// motions' velocity and position:
///   (p1 - p0) / t = v - g t / 2 - R0 (a - b / t),   (p2 - p1) / u = v + g u / 2 + R1 (b' / u),
/// of which the difference, over (t + u) / 2, is free of v.
bool GravityFactor::Evaluate(double const* const* parameters, double* residuals,
                             double** jacobians) const {
  const Pose poses[] = {from_block(parameters[0]), from_block(parameters[1]),
                        from_block(parameters[2])};
  const Eigen::Map<const Eigen::Vector3d> gravity(parameters[3]);
  const Eigen::Map<const Eigen::Vector3d> bias(parameters[3] + 3);
  const Eigen::Vector3d felt[] = {first_.of(bias), second_.of(bias)};
  const Eigen::Vector3d gained = (poses[2].translation - poses[1].translation) / after_ -
                                 (poses[1].translation - poses[0].translation) / before_;
  Eigen::Map<Eigen::Vector3d> r(residuals);
  r = weight_ * (gained - poses[0].rotation * felt[0] - poses[1].rotation * felt[1]) -
      gravity_ * gravity;
  if (jacobians == nullptr) return true;
  using RowMajor37 = Eigen::Matrix<double, 3, 7, Eigen::RowMajor>;
  using RowMajor36 = Eigen::Matrix<double, 3, 6, Eigen::RowMajor>;
  const double shares[] = {1 / before_, -1 / before_ - 1 / after_, 1 / after_};
  for (int i = 0; i < 3; ++i) {
    if (jacobians[i] == nullptr) continue;
    const Eigen::Matrix3d R = poses[i].rotation.toRotationMatrix();
    Eigen::Map<RowMajor37> block(jacobians[i]);
    block.setZero();
    block.leftCols<3>() = weight_ * shares[i] * R;
    if (i < 2) block.middleCols<3>(3) = weight_ * R * cross_matrix(felt[i]);
  }
  if (jacobians[3] != nullptr) {
    Eigen::Map<RowMajor36> block(jacobians[3]);
    block.leftCols<3>() = -gravity_ * Eigen::Matrix3d::Identity();
    block.rightCols<3>() = -weight_ * (poses[0].rotation.toRotationMatrix() * first_.by_bias +
                                       poses[1].rotation.toRotationMatrix() * second_.by_bias);
  }
  return true;
}

}  // namespace vinebench::slam
