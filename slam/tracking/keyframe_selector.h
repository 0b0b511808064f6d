// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "slam/map/map.h"
#include "slam/tracking/keyframe_config.h"
#include "slam/tracking/tracker.h"

namespace vinebench::slam {

/// Whether a tracked frame should become a keyframe (paper, Sect. III-A): it tracks too few
/// landmarks, far fewer than the last keyframe's well-founded ones (seen by three keyframes), or
/// the body has moved or turned on since then.
bool wants_keyframe(const TrackedFrame& tracked, const Map& map, const KeyframeConfig& config);

}  // namespace vinebench::slam
