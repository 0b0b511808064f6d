// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/config/config_field.h"

namespace vinebench::slam {

/// When a tracked frame becomes a keyframe.
struct KeyframeConfig {
  int min_inliers = 200;   ///< fewer tracked landmarks ask for a keyframe
  double reduction = 0.7;  ///< so does falling below this share of the last keyframe's
  double distance = 0.25;  ///< m from the last keyframe
  double angle_deg = 12;   ///< turned since the last keyframe
  int min_gap = 1;         ///< frames between keyframes

  template <class Archive>
  void serialize(Archive& archive) {
    archive("min_inliers", min_inliers, Range::non_negative());
    archive("reduction", reduction, Range::between(0, 1));
    archive("distance", distance, Range::positive());
    archive("angle_deg", angle_deg, Range::positive());
    archive("min_gap", min_gap, Range::between(1, 1000));
  }
};

}  // namespace vinebench::slam
