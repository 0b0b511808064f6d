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

/// Whether the body has moved or turned twice as far as keyframes may be apart.
bool is_overdue(const TrackedFrame& tracked, const Map& map, const KeyframeConfig& config);

/// Whether a loaded map, to which no keyframe was added yet, knows the place as well as a new
/// keyframe would.
bool is_covered(const TrackedFrame& tracked, const Map& map, const KeyframeConfig& config);

/// Whether a tag is in view, and from so far from the last keyframe that it says more.
bool sees_tag_from_elsewhere(const TrackedFrame& tracked, const Map& map);

}  // namespace vinebench::slam
