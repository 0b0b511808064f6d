// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "slam/camera/estimator_rig.h"
#include "slam/map/map.h"

namespace vinebench::slam {

/// What a frame sees of what the map has around a pose.
struct PlaceEvidence {
  Pose T_map_body;            ///< adjusted to what is found
  std::vector<int> expected;  ///< of each view, landmarks that it would have in view from there
  std::vector<int> alike;     ///< those of them that something near resembles
  std::vector<int> found;     ///< those of these that are where they are to be
};

/// Looks for the landmarks around `T_map_body`, which may be off by a few centimetres and tenths of
/// a degree.
PlaceEvidence look_around(const Map& map, const EstimatorRig& rig, const FrameFeatures& frame,
                          const Pose& T_map_body);

/// The same for these landmarks.
PlaceEvidence look_around(const Map& map, const EstimatorRig& rig, const FrameFeatures& frame,
                          const Pose& T_map_body, const std::vector<int>& landmarks);

/// Whether that is enough to contradict what else is known: every view that is to see a place sees
/// it. Vines that stand as others do may deceive one pair of cameras, not two that look apart.
bool bears_out(const PlaceEvidence& evidence);

}  // namespace vinebench::slam
