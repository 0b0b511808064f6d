// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "core/geometry/pose.h"

namespace vinebench::slam {

inline constexpr double kStandardGravity = 9.80665;  ///< m/s^2
inline constexpr double kGravitySpread = 0.03;       ///< m/s^2, over the Earth

/// Gravity as it lies in a map, and what is taken from the accelerometer's readings to see it so.
struct MapGravity {
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();             ///< m/s^2, map frame
  Eigen::Vector3d accelerometer_bias = Eigen::Vector3d::Zero();  ///< m/s^2, body frame
  /// Of both: a body that does not turn feels only what they add up to.
  Matrix6d covariance = Matrix6d::Identity();
  /// Whether its direction is the world's vertical, and not what readings say.
  bool by_world = false;
};

}  // namespace vinebench::slam
