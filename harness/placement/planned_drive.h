// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "harness/experiment/scenario.h"
#include "harness/placement/pose_chain.h"
#include "harness/placement/tag_candidates.h"

namespace vinebench::harness {

/// A drive through a world for which tags or cameras are planned.
struct PlannedDrive {
  ScenarioConfig scenario;
  Rig rig;                  ///< of the rover, with a camera for tags
  std::vector<Pose> poses;  ///< half a metre apart
  PoseChain chain;          ///< of these
  SightingModel sightings{};

  const sim::WorldConfig& world() const { return scenario.simulation.world; }
};

/// The route and rover of a scenario in the world of a file, in place of its own. Throws Error,
/// also if the rover has no camera for tags.
PlannedDrive plan_drive(const std::filesystem::path& world, const std::filesystem::path& route,
                        const OdometryDrift& drift, const SurveyAccuracy& survey);

/// The world's own tags with what the drive sees of them.
std::vector<TagCandidate> own_tags(const PlannedDrive& drive);

/// The places on posts, likewise, at that height and of that size, m. Throws Error if the world has
/// no posts.
std::vector<TagCandidate> post_candidates(const PlannedDrive& drive, double height, double size);

}  // namespace vinebench::harness
