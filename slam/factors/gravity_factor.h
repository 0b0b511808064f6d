// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/sized_cost_function.h>

#include "slam/odometry/preintegrated_motion.h"

namespace vinebench::slam {

/// Gravity as an inertial unit feels it between three poses, against what it is in the map: what
/// the poses accelerate by, less the specific force, in standard deviations. The velocity at the
/// middle pose is eliminated: how fast the body is neither has to be known nor is estimated.
/// Parameters are the three poses, in order of time (7 each), and gravity in the map with the
/// accelerometer's bias (m/s^2, 6).
class GravityFactor : public ceres::SizedCostFunction<3, 7, 7, 7, 6> {
 public:
  /// `before`, `after`: the motion to and from the middle pose; `sigma` in m/s^2.
  GravityFactor(const PreintegratedMotion& before, const PreintegratedMotion& after, double sigma);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  /// By which the mean velocity over an interval differs from that at the middle pose, m/s: in the
  /// axes of the interval's first pose, and by the bias (s).
  struct Difference {
    Eigen::Vector3d at_bias;
    Eigen::Matrix3d by_bias;
    Eigen::Vector3d bias;
    Eigen::Vector3d of(const Eigen::Vector3d& bias) const;
  };

  double before_;   ///< s
  double after_;    ///< s
  double weight_;   ///< of the difference of the two mean velocities, in standard deviations a m/s
  double gravity_;  ///< standard deviations a m/s^2
  Difference first_;
  Difference second_;
};

}  // namespace vinebench::slam
