// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/geometry/rig.h"
#include "harness/experiment/scenario.h"
#include "harness/placement/pose_chain.h"

namespace vinebench::harness {

/// A place for a tag, and what a drive sees of it.
struct TagCandidate {
  sim::WorldConfig::Tag tag;
  WorldTag placed;
  /// By pose of the drive: what the sightings of it say of that pose.
  std::vector<std::pair<std::size_t, Matrix6d>> information{};
};

/// How tags are seen, for a prediction.
struct SightingModel {
  double corner_sigma = 0.2;     ///< px, of a corner in x or y
  SurveyAccuracy survey{};       ///< of a tag in the world
  double vine_clearance = 0.30;  ///< m; a line of sight may come so near to the tag's own row
};

/// Poses of the body along a scenario's route, on the ground, each so many metres after the one
/// before, or so much of a turn.
std::vector<Pose> route_poses(const ScenarioConfig& scenario, double spacing);

/// A tag on either side of every post, at that height, with the numbers of the family from 0 on.
std::vector<TagCandidate> post_candidates(const sim::WorldConfig& world, double height,
                                          double size);

/// The world's own tags.
std::vector<TagCandidate> own_tags(const sim::WorldConfig& world);

/// Fills in what the drive sees of each: in view of a tag camera with nothing between, rows of
/// vines being opaque. What a sighting says is the information of its four corners and of the
/// survey.
void predict_sightings(std::vector<TagCandidate>& candidates, const std::vector<Pose>& poses,
                       const Rig& rig, const sim::WorldConfig& world, const SightingModel& model);

}  // namespace vinebench::harness
