// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "slam/map/map.h"
#include "slam/odometry/inertial_config.h"

namespace vinebench::slam {

/// The likeliest turn (map frame) of a map that is thought to lie so that `down` (a unit vector)
/// points down, with that covariance (rad^2, map frame) of how it leans, and in which gravity was
/// `felt`: none about the vertical. Nothing where the two cannot both be true (99.9 % chi-square).
std::optional<Eigen::Quaterniond> levelling_turn(const MapGravity& felt,
                                                 const Eigen::Vector3d& down,
                                                 const Eigen::Matrix3d& lean);

/// Turns the map about a tag of known pose by the likeliest turn, and has it believe in gravity
/// along `down`. `turn` is the covariance of the tag's turn against the map, in its own frame
/// (rad^2); what all of the way is turned by against it, by the errors of its steps, adds to that.
/// Nothing changes where no gravity was felt, or not such.
void level_about(Map& map, const Pose& T_map_tag, const Eigen::Matrix3d& turn,
                 const Eigen::Vector3d& down, const InertialNoise& inertial);

}  // namespace vinebench::slam
