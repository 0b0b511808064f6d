// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/loop/tag_dissent.h"

#include "core/geometry/step_covariance.h"
#include "slam/optimisation/tag_localisation.h"

namespace vinebench::slam {
namespace {

/// Whether `b`, seen after `a`, is where both surveys say.
bool agree(const TagWitness& a, const TagWitness& b, const Map& map, const Matrix6d& drift) {
  const Pose found = a.found(map).T_map_tag.inverse() * b.found(map).T_map_tag;
  const Pose surveyed = a.T_world_tag.inverse() * b.T_world_tag;
  const Matrix6d expected = b.covariance + carry_covariance(a.covariance, surveyed) +
                            carry_covariance(drift, b.T_keyframe_tag);
  return pose_chi_squared(found, surveyed, expected) <= kPoseLimit;
}

}  // namespace

void TagDissent::hear(const TagWitness& witness) {
  std::erase_if(witnesses_, [&](const TagWitness& before) { return same_tag(before, witness); });
  witnesses_.push_back(witness);
}

std::vector<TagWitness> TagDissent::agreeing(const Map& map, const Drift& drift) const {
  std::vector<TagWitness> group;
  if (witnesses_.empty()) return group;
  const TagWitness& last = witnesses_.back();
  for (const TagWitness& witness : witnesses_) {
    const bool same = &witness == &last;
    if (same || agree(witness, last, map, drift(witness.path_length, last.path_length))) {
      group.push_back(witness);
    }
  }
  return group;
}

}  // namespace vinebench::slam
