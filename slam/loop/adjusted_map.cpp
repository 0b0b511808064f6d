// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/loop/adjusted_map.h"

#include <algorithm>

#include "slam/loop/loop_correction.h"

namespace vinebench::slam {
namespace {

std::vector<std::pair<int, Observation>> removed_between(const Map& before, const Map& after) {
  std::vector<std::pair<int, Observation>> removed;
  for (const Landmark& landmark : before.landmarks()) {
    const std::vector<Observation>& left = after.landmark(landmark.id).observations;
    if (left.size() == landmark.observations.size()) continue;
    for (const Observation& o : landmark.observations) {
      if (std::ranges::count(left, o) == 0) removed.emplace_back(landmark.id, o);
    }
  }
  return removed;
}

/// Local mapping may have given the feature to another landmark since.
void remove_if_there(int landmark, const Observation& o, Map& map) {
  const auto& of_view = map.keyframe(o.keyframe).landmarks[static_cast<std::size_t>(o.view)];
  if (of_view[static_cast<std::size_t>(o.feature)] == landmark) map.remove_observation(landmark, o);
}

}  // namespace

Map copy_for_adjustment(const Map& map) {
  Map copy(map.level_scale());
  copy.keyframes().reserve(map.keyframes().size());
  for (const Keyframe& keyframe : map.keyframes()) {
    Keyframe& other = copy.keyframes().emplace_back();
    other.id = keyframe.id;
    other.frame = keyframe.frame;
    other.T_map_body = keyframe.T_map_body;
    other.motion = keyframe.motion;
    other.landmarks = keyframe.landmarks;
    other.link = keyframe.link;
  }
  copy.landmarks() = map.landmarks();
  copy.tags() = map.tags();
  copy.calibration() = map.calibration();
  copy.world() = map.world();
  copy.gravity() = map.gravity();
  return copy;
}

AdjustedMap adjust_copy(Map copy, const std::function<void(Map&)>& adjust) {
  AdjustedMap adjusted{copy, {}};
  adjust(adjusted.map);
  adjusted.removed = removed_between(copy, adjusted.map);
  return adjusted;
}

Pose take_over(const AdjustedMap& adjusted, Map& map) {
  const Map& copy = adjusted.map;
  const auto known = static_cast<int>(copy.keyframes().size());
  const Pose T_new_old =
      copy.keyframe(known - 1).T_map_body * map.keyframe(known - 1).T_map_body.inverse();
  move_from(map, known, T_new_old);
  for (const Keyframe& keyframe : copy.keyframes()) {
    map.keyframe(keyframe.id).T_map_body = keyframe.T_map_body;
  }
  for (const Landmark& landmark : copy.landmarks()) {
    if (landmark.removed) continue;
    Landmark& mine = map.landmark(landmark.id);
    mine.position = landmark.position;
    mine.normal = landmark.normal;
    mine.max_distance = landmark.max_distance;
  }
  for (const auto& [landmark, observation] : adjusted.removed) {
    remove_if_there(landmark, observation, map);
  }
  for (MapTag& tag : map.tags()) {
    const MapTag* there = copy.find_tag(tag.family, tag.id);
    if (there != nullptr) {
      tag.T_map_tag = there->T_map_tag;
      tag.sure = there->sure;
    } else if (!map.is_held(tag)) {
      tag.T_map_tag = T_new_old * tag.T_map_tag;
    }
  }
  if (copy.world()) map.world() = copy.world();
  if (copy.gravity()) map.gravity() = copy.gravity();
  return T_new_old;
}

}  // namespace vinebench::slam
