// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "slam/map/map.h"

namespace vinebench::slam {

/// What a keyframe's step from the one before is off by, along or about one axis, grows with the
/// root of the way: so much after one metre.
inline constexpr double kStepOffset = 1e-3;  // m
inline constexpr double kStepTurn = 2e-4;    // rad

/// Spreads the correction of a loop before the global adjustment: the likeliest way that `last` can
/// have come near `corrected`, whose covariance (of the steps of step_of about it) is given, from
/// `first`, which stays. Errors of the steps between are independent, as above, or what the dead
/// reckoning of an odometry gap says; an early turn swings all of the way after it. In
/// closed form to first order (Dubbelman and Browning, "COP-SLAM: closed-form online pose-chain
/// optimization for visual SLAM", 2015). Every landmark moves with the keyframe that made it.
void spread_correction(Map& map, int first, int last, const Pose& corrected,
                       const Matrix6d& covariance);

/// Moves `first`, all later keyframes and the landmarks that they made by `T_new_old`.
void move_from(Map& map, int first, const Pose& T_new_old);

/// Moves all of the map by `T_new_old`, but for the world and the tags that hold the map.
void move_map(Map& map, const Pose& T_new_old);

/// Moves the map with the world in it, so that the world is where it was before. Returns the move.
Pose keep_world(Map& map, const Pose& T_map_world_before);

}  // namespace vinebench::slam
