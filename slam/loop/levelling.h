// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "slam/map/map.h"

namespace vinebench::slam {

/// The likeliest turn (map frame) of a map that is thought to lie so that `down` (a unit vector)
/// points down, with that covariance (rad^2, map frame) of how it leans, and in which gravity was
/// `felt`: none about the vertical. Nothing where the two cannot both be true (99.9 % chi-square).
std::optional<Eigen::Quaterniond> levelling_turn(const MapGravity& felt,
                                                 const Eigen::Vector3d& down,
                                                 const Eigen::Matrix3d& lean);

/// Turns all of the map about `pivot`, but for tags of known pose.
void turn_about(Map& map, const Eigen::Vector3d& pivot, const Eigen::Quaterniond& turn);

}  // namespace vinebench::slam
