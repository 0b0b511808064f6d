// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "core/geometry/pose.h"
#include "core/slam_system.h"
#include "slam/map/map.h"

namespace vinebench::slam {

/// The tags with that accuracy where they do not say their own.
std::vector<RegisteredTag> with_accuracy(std::vector<RegisteredTag> tags,
                                         const SurveyAccuracy& otherwise);

/// Whether a tag stands exactly where it was surveyed.
bool is_exact(const SurveyAccuracy& survey);

/// Of a surveyed tag in the world, in the tag's own frame.
Matrix6d survey_covariance(const SurveyAccuracy& survey);

/// A registered tag that was found in the map.
struct FoundTag {
  Pose T_world_tag;                            ///< as surveyed
  Pose T_map_tag;                              ///< as found
  Matrix6d covariance = Matrix6d::Identity();  ///< of how they differ, in the tag's own frame
};

/// How that tag lies against its survey if the map lies so in the world, in the step of step_of.
Vector6d misplacement(const FoundTag& tag, const Pose& T_map_world);

/// The likeliest T_map_world by these tags, of which there must be one at least.
Pose likeliest_world(const std::vector<FoundTag>& tags);

/// T_map_world by all surveyed tags of the map where they are now in it; Map::world() if it has not
/// several of them, or one that is exact. Global adjustments weigh surveys likewise, but outliers
/// less, and have gravity beside them where an inertial unit takes part.
std::optional<Pose> world_by_tags(const Map& map);

}  // namespace vinebench::slam
