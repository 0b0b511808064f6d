// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/config/config_field.h"
#include "core/geometry/angle.h"
#include "core/slam_system.h"

namespace vinebench::slam {

/// When a tag closes a loop, and what is believed of it.
struct LoopConfig {
  bool enabled = true;         ///< whether tags close loops
  double away_seconds = 3;     ///< a tag unseen for this long was left
  double away_distance = 1.0;  ///< m, the way driven meanwhile
  double corner_sigma =
      0.08;  ///< px, by which a tag's corner is off besides its noise: lens, print, blur
  /// Accuracy of the survey of registered tags that do not say their own, standard deviations of
  /// each axis of a tag.
  double survey_position = 0;      ///< m
  double survey_rotation_deg = 0;  ///< degrees
  /// A tag that is farther from its place in the map than this is not believed: a share of the way
  /// driven since a tag was seen, m, and degrees with degrees a metre.
  double max_drift = 0.02;
  double max_offset = 0.05;             ///< m, as max_drift
  double max_turn_deg = 3;              ///< as max_drift
  double max_turn_deg_per_metre = 0.3;  ///< as max_drift

  SurveyAccuracy survey() const {
    return {survey_position, survey_rotation_deg * kRadiansPerDegree};
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive("enabled", enabled);
    archive("away_seconds", away_seconds, Range::non_negative());
    archive("away_distance", away_distance, Range::non_negative());
    archive("corner_sigma", corner_sigma, Range::positive());
    archive("survey_position", survey_position, Range::between(0, 10));
    archive("survey_rotation_deg", survey_rotation_deg, Range::between(0, 90));
    archive("max_drift", max_drift, Range::between(0, 1));
    archive("max_offset", max_offset, Range::positive());
    archive("max_turn_deg", max_turn_deg, Range::positive());
    archive("max_turn_deg_per_metre", max_turn_deg_per_metre, Range::non_negative());
  }
};

}  // namespace vinebench::slam
