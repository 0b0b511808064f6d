// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "core/geometry/pose.h"
#include "slam/odometry/preintegrated_motion.h"

namespace vinebench::test {

/// A body that weaves, heaves and tilts, in a map in which gravity is not along an axis.
struct SwingingBody {
  Eigen::Vector3d gravity = exp_so3({0.1, -0.2, 0}) * Eigen::Vector3d(0, 0, -9.8);  ///< m/s^2

  static Pose pose(double t) {
    return {
        from_roll_pitch_yaw({0.1 * std::sin(t), 0.08 * std::sin(0.8 * t), 0.6 * std::sin(0.7 * t)}),
        {std::sin(0.6 * t), 1 - std::cos(0.5 * t), 0.05 * std::sin(1.3 * t)}};
  }

  /// What an inertial unit with such a bias measures, from which `taken` is taken away.
  slam::PreintegratedMotion motion(double from, double until,
                                   const Eigen::Vector3d& bias = Eigen::Vector3d::Zero(),
                                   const Eigen::Vector3d& taken = Eigen::Vector3d::Zero()) const {
    constexpr double kH = 1e-4;  // s, of the differences
    constexpr int kSteps = 400;
    const double dt = (until - from) / kSteps;
    slam::PreintegratedMotion motion;
    for (int i = 0; i < kSteps; ++i) {
      const double t = from + (i + 0.5) * dt;
      const Eigen::Vector3d acceleration =
          (pose(t + kH).translation - 2 * pose(t).translation + pose(t - kH).translation) /
          (kH * kH);
      const Eigen::Vector3d turn_rate =
          log_so3(pose(t - kH).rotation.conjugate() * pose(t + kH).rotation) / (2 * kH);
      motion.add(turn_rate, pose(t).rotation.conjugate() * (acceleration - gravity) + bias - taken,
                 taken, dt);
    }
    return motion;
  }
};

}  // namespace vinebench::test
