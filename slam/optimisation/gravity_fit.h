// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "slam/map/map.h"
#include "slam/odometry/inertial_config.h"

namespace vinebench::slam {

/// What an inertial unit felt between three keyframes in a row, for a GravityFactor.
struct FeltGravity {
  const PreintegratedMotion& before;
  const PreintegratedMotion& after;
  double sigma = 0;  ///< m/s^2
};

/// At keyframes `last` - 2 to `last`; none where a motion is missing or took too long.
std::optional<FeltGravity> felt_gravity(const Map& map, int last, const InertialNoise& inertial);

/// Gravity in the map and the accelerometer's bias that agree best (least squares) with what was
/// felt between all of its keyframes, whose poses are taken as they are. None where nothing was
/// felt. Where the body never turned, covariance and estimate are those of the sum, parted by what
/// is believed of the bias beforehand.
std::optional<MapGravity> fit_gravity(const Map& map, const InertialNoise& inertial);

}  // namespace vinebench::slam
