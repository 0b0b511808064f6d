// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/config/config_field.h"
#include "slam/features/orb_extractor.h"
#include "slam/odometry/dead_reckoning.h"
#include "slam/patches/patch.h"
#include "slam/stereo/stereo_matcher.h"
#include "slam/tags/tag_detector.h"

namespace vinebench::slam {

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

/// Fine placement of matches on the landmark's patch.
struct RefinementConfig {
  bool enabled = true;
  double max_residual = 0.35;  ///< mean difference to the patch as a share of its contrast, at most
  double noise = 2.0;          ///< grey levels, difference that the sensor's noise alone explains
  double sigma = 0.15;         ///< px of the feature's level, standard deviation once placed
  double disparity_sigma = 0.2;  ///< px of the feature's level, of a stereo match
  double tolerance = 2.3;  ///< the outliers' limit in multiples of the usual one: tails are long
  int follow = 1200;  ///< landmarks a view that are looked for by their patch, with those matched

  /// Whether the patch was found where it fits best.
  bool accepts(const PatchFit& fit) const {
    return fit.difference <= noise + max_residual * fit.contrast;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive("enabled", enabled);
    archive("max_residual", max_residual, Range::between(0, 2));
    archive("noise", noise, Range::between(0, 50));
    archive("sigma", sigma, Range::between(0.01, 5));
    archive("disparity_sigma", disparity_sigma, Range::between(0.01, 5));
    archive("tolerance", tolerance, Range::between(1, 10));
    archive("follow", follow, Range::non_negative());
  }
};

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

/// When what local mapping found out reaches tracking.
enum class MappingSchedule {
  kLockstep,  ///< after a fixed number of frames: the same result on every machine
  kLive,      ///< as soon as it is there; tracking never waits for it
};
inline std::vector<std::string> yaml_names(MappingSchedule) {
  return {"lockstep", "live"};
}

struct MappingConfig {
  MappingSchedule schedule = MappingSchedule::kLockstep;
  int delay = 4;       ///< frames after which a local adjustment joins in lockstep; 0 is at once
  int window = 10;     ///< keyframes that a local adjustment moves
  int iterations = 6;  ///< of a local adjustment
  int global_iterations = 25;  ///< of a global adjustment
  int min_observations = 3;    ///< keyframes that must see a landmark (paper, Sect. III-A)
  int trial_keyframes = 3;     ///< keyframes after which a landmark with fewer is dropped
  int neighbours = 6;          ///< covisible keyframes searched for new landmarks

  template <class Archive>
  void serialize(Archive& archive) {
    archive("schedule", schedule);
    archive("delay", delay, Range::between(0, 100));
    archive("window", window, Range::between(2, 100));
    archive("iterations", iterations, Range::between(1, 100));
    archive("global_iterations", global_iterations, Range::between(1, 500));
    archive("min_observations", min_observations, Range::between(2, 10));
    archive("trial_keyframes", trial_keyframes, Range::between(1, 100));
    archive("neighbours", neighbours, Range::between(0, 100));
  }
};

struct LoopConfig {
  bool enabled = true;
  double away_seconds = 3;     ///< a tag unseen for this long was left
  double away_distance = 1.0;  ///< m, the way driven meanwhile
  double corner_sigma =
      0.15;  ///< px, by which a tag's corner is off besides its noise: lens, print
  /// A tag that is farther from its place in the map than this is not believed: a share of the way
  /// driven since a tag was seen, m, and degrees with degrees a metre.
  double max_drift = 0.02;
  double max_offset = 0.05;
  double max_turn_deg = 3;
  double max_turn_deg_per_metre = 0.3;

  template <class Archive>
  void serialize(Archive& archive) {
    archive("enabled", enabled);
    archive("away_seconds", away_seconds, Range::non_negative());
    archive("away_distance", away_distance, Range::non_negative());
    archive("corner_sigma", corner_sigma, Range::positive());
    archive("max_drift", max_drift, Range::between(0, 1));
    archive("max_offset", max_offset, Range::positive());
    archive("max_turn_deg", max_turn_deg, Range::positive());
    archive("max_turn_deg_per_metre", max_turn_deg_per_metre, Range::non_negative());
  }
};

struct SlamConfig {
  /// Names of the stereo pairs and tag cameras in use; all of the rig where empty.
  std::vector<std::string> cameras;
  OrbConfig features;
  StereoConfig stereo;
  TrackingConfig tracking;
  RefinementConfig refinement;
  KeyframeConfig keyframes;
  MappingConfig mapping;
  DeadReckoningConfig dead_reckoning;
  TagDetectorConfig tags;
  LoopConfig loop;

  template <class Archive>
  void serialize(Archive& archive) {
    archive("cameras", cameras);
    archive("features", features);
    archive("stereo", stereo);
    archive("tracking", tracking);
    archive("refinement", refinement);
    archive("keyframes", keyframes);
    archive("mapping", mapping);
    archive("dead_reckoning", dead_reckoning);
    archive("tags", tags);
    archive("loop", loop);
  }
};

}  // namespace vinebench::slam
