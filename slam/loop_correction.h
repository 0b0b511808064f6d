// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "slam/map.h"

namespace vinebench {

/// Spreads the correction of a loop before the global adjustment: moves keyframes after `first` up
/// to `last`, which comes to `corrected`, by a growing part of it, by the way driven, and every
/// landmark with the keyframe that made it.
void spread_correction(Map& map, int first, int last, const Pose& corrected);

}  // namespace vinebench
