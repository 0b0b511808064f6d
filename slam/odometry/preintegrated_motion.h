// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace vinebench::slam {

/// What an inertial unit measured of a body's motion between two instants: all but what gravity and
/// the velocity at the first add to it, in the body's axes at the first (Forster et al.,
/// "On-Manifold Preintegration for Real-Time Visual-Inertial Odometry", T-RO 2017, Sect. VI).
struct PreintegratedMotion {
  double seconds = 0;
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m
  /// By how much these change for each m/s^2 that the accelerometer's bias is larger.
  Eigen::Matrix3d velocity_by_bias = Eigen::Matrix3d::Zero();    ///< s
  Eigen::Matrix3d position_by_bias = Eigen::Matrix3d::Zero();    ///< s^2
  Eigen::Vector3d accelerometer_bias = Eigen::Vector3d::Zero();  ///< m/s^2, taken away: the mean

  /// Goes on by `dt` s with these turn rate (rad/s) and specific force (m/s^2), body axes, from
  /// which the biases were taken away.
  void add(const Eigen::Vector3d& turn_rate, const Eigen::Vector3d& force,
           const Eigen::Vector3d& bias, double dt);
};

}  // namespace vinebench::slam
