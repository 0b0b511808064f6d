// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/config/config_field.h"

namespace vinebench::slam {

/// When a place closes a loop by its looks, without a tag. Rows of vines look alike, so only what
/// lies within the drift of the way since is looked at.
struct PlacesConfig {
  double away_distance = 5;  ///< m, the way driven since the place was seen
  double max_offset = 0.1;   ///< m, what the place may be off besides drift
  double max_drift = 0.005;  ///< share of that way
  double max_turn_deg = 3;   ///< what the body may be turned by against it

  template <class Archive>
  void serialize(Archive& archive) {
    archive("away_distance", away_distance, Range::positive());
    archive("max_offset", max_offset, Range::positive());
    archive("max_drift", max_drift, Range::between(0, 1));
    archive("max_turn_deg", max_turn_deg, Range::between(0.1, 90));
  }
};

}  // namespace vinebench::slam
