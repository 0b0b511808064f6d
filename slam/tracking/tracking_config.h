// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/config/config_field.h"

namespace vinebench::slam {

/// Settings of Tracker.
struct TrackingConfig {
  double radius = 10;             ///< px, of the first search around a landmark's projection
  double radius_growth = 2;       ///< factor while there are too few matches
  int radius_steps = 3;           ///< searches at most
  int min_matches = 60;           ///< fewer let the radius grow (paper, Sect. III-A)
  double local_radius = 4;        ///< px, of the second search, around the refined pose
  int max_hamming = 64;           ///< bits
  double second_best = 0.85;      ///< the best must be below this share of the second best
  int min_inliers = 20;           ///< fewer is lost
  double min_inlier_share = 0.4;  ///< of the matches; a camera (or all) below it is not believed
  int local_keyframes = 20;       ///< keyframes whose landmarks are looked for
  double max_speed = 35;          ///< m/s; a pose found by appearance alone lies within its reach

  template <class Archive>
  void serialize(Archive& archive) {
    archive("radius", radius, Range::between(1, 200));
    archive("radius_growth", radius_growth, Range::between(1, 10));
    archive("radius_steps", radius_steps, Range::between(1, 10));
    archive("min_matches", min_matches, Range::non_negative());
    archive("local_radius", local_radius, Range::between(1, 100));
    archive("max_hamming", max_hamming, Range::between(1, 256));
    archive("second_best", second_best, Range::between(0.1, 1));
    archive("min_inliers", min_inliers, Range::between(6, 10000));
    archive("min_inlier_share", min_inlier_share, Range::between(0, 1));
    archive("local_keyframes", local_keyframes, Range::between(1, 1000));
    archive("max_speed", max_speed, Range::positive());
  }
};

}  // namespace vinebench::slam
