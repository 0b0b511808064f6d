// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/adjustment_window.h"

namespace vinebench::slam {

AdjustmentWindow local_window(const Map& map, int keyframe, int size) {
  AdjustmentWindow window;
  std::vector<char> role(map.keyframes().size(), 0);  // 1 moved, 2 fixed
  const auto at = [&](int id) -> char& { return role[static_cast<std::size_t>(id)]; };
  at(keyframe) = 1;
  for (const int id : map.covisible(keyframe, size - 1)) at(id) = 1;
  at(0) = 2;
  // Behind an odometry gap the map depends on the keyframe that restarted it.
  for (const Keyframe& other : map.keyframes()) {
    if (other.link) at(other.id) = 2;
  }
  std::vector<char> visited(map.landmarks().size(), 0);
  for (std::size_t k = 0; k < role.size(); ++k) {
    if (role[k] != 1) continue;
    for (const std::vector<int>& view : map.keyframes()[k].landmarks) {
      for (const int id : view) {
        if (id < 0 || visited[static_cast<std::size_t>(id)]) continue;
        visited[static_cast<std::size_t>(id)] = 1;
        for (const Observation& o : map.landmark(id).observations) {
          if (at(o.keyframe) == 0) at(o.keyframe) = 2;
        }
      }
    }
  }
  for (std::size_t k = 0; k < role.size(); ++k) {
    if (role[k] == 1) window.moved.push_back(static_cast<int>(k));
    if (role[k] == 2) window.fixed.push_back(static_cast<int>(k));
  }
  return window;
}

AdjustmentWindow global_window(const Map& map) {
  bool held_by_tag = false;
  for (const MapTag& tag : map.tags()) held_by_tag |= map.is_held(tag);
  AdjustmentWindow window;
  for (const Keyframe& keyframe : map.keyframes()) {
    const bool fixed = keyframe.id == 0 && !held_by_tag;
    (fixed ? window.fixed : window.moved).push_back(keyframe.id);
  }
  return window;
}

}  // namespace vinebench::slam
