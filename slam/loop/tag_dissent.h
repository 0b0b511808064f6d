// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "slam/loop/tag_survey.h"
#include "slam/map/map.h"

namespace vinebench::slam {

/// A registered tag that was seen elsewhere than where it was expected.
struct TagWitness {
  std::string family;
  int id = 0;
  Pose T_world_tag;                            ///< as surveyed
  int keyframe = 0;                            ///< the last one when it was seen
  Pose T_keyframe_tag;                         ///< as seen
  Matrix6d covariance = Matrix6d::Identity();  ///< of sighting and survey, in the tag's own frame
  double path_length = 0;                      ///< m, the way driven until then
  TagSighting sighting;

  FoundTag found(const Map& map) const {
    return {T_world_tag, map.keyframe(keyframe).T_map_body * T_keyframe_tag, covariance};
  }
};

/// The registered tags that contradict the map: alone, each is likely to be wrong itself; of
/// several that agree with each other, all that they contradict is.
class TagDissent {
 public:
  /// Covariance of the body's motion between two lengths of the way, in the step of step_of.
  using Drift = std::function<Matrix6d(double since, double path_length)>;

  /// The latest of what a tag says counts.
  void hear(const TagWitness& witness);

  /// The last one heard and all others that stand against it as they were surveyed, within
  /// both sightings, both surveys and the drift between them (99.9 % chi-square).
  std::vector<TagWitness> agreeing(const Map& map, const Drift& drift) const;

  void forget() { witnesses_.clear(); }
  bool empty() const { return witnesses_.empty(); }

 private:
  std::vector<TagWitness> witnesses_;  ///< a tag each, in the order of what was heard last
};

}  // namespace vinebench::slam
