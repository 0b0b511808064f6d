// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "slam/map/map.h"

namespace vinebench::slam {

/// What an adjustment needs of a map: all but patches and covisibility, which are most of its
/// bytes. Frames are shared.
Map copy_for_adjustment(const Map& map);

/// A copy of a map, adjusted while the map itself grew.
struct AdjustedMap {
  Map map;
  std::vector<std::pair<int, Observation>> removed;  ///< by the adjustment, of these landmarks
};

/// Adjusts a copy. Touches nothing else.
AdjustedMap adjust_copy(Map copy, const std::function<void(Map&)>& adjust);

/// Moves a map to where its adjusted copy is: keyframes, landmarks and tags that the copy has, to
/// their places there; what came since, as the last keyframe of the copy moves. Local adjustments
/// since then are overwritten where the copy knows better, but nothing else may have moved the
/// map, nor may a registered tag have told since then where the world is. Returns how that keyframe
/// moved: T_map_new T_map_old^-1.
Pose take_over(const AdjustedMap& adjusted, Map& map);

}  // namespace vinebench::slam
