// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "slam/map/map.h"

namespace vinebench::slam {

/// Which keyframes an adjustment moves, and which it only looks at. The landmarks that a moved
/// keyframe sees are adjusted with them.
struct AdjustmentWindow {
  std::vector<int> moved;  ///< keyframe ids, ascending
  std::vector<int> fixed;  ///< keyframe ids, ascending
};

/// The keyframe, those that share most landmarks with it, and as fixed ones all others that see
/// their landmarks. The first keyframe of the map and those that restart it after an interval
/// without sight are fixed.
AdjustmentWindow local_window(const Map& map, int keyframe, int size);

/// All keyframes; the first is fixed unless a tag holds the map.
AdjustmentWindow global_window(const Map& map);

}  // namespace vinebench::slam
