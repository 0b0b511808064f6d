// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/loop_correction.h"

namespace vinebench {

void spread_correction(Map& map, int first, int last, const Pose& corrected) {
  std::vector<double> way{0};
  for (int k = first + 1; k <= last; ++k) {
    way.push_back(way.back() + (map.keyframe(k).T_map_body.translation -
                                map.keyframe(k - 1).T_map_body.translation)
                                   .norm());
  }
  // The correction turns about the place of the last keyframe, so that its lever arm stays short.
  const Pose T_last_new = map.keyframe(last).T_map_body.inverse() * corrected;
  std::vector<Pose> moves(map.keyframes().size());
  for (int k = first + 1; k <= last; ++k) {
    const double share = way.back() > 0 ? way[static_cast<std::size_t>(k - first)] / way.back() : 1;
    const Pose T_last_part = interpolate(Pose{}, T_last_new, share);
    const Pose& T_map_last = map.keyframe(last).T_map_body;
    moves[static_cast<std::size_t>(k)] = T_map_last * T_last_part * T_map_last.inverse();
  }
  for (Landmark& landmark : map.landmarks()) {
    landmark.position =
        moves[static_cast<std::size_t>(landmark.first_keyframe)] * landmark.position;
  }
  for (int k = first + 1; k <= last; ++k) {
    Pose& T_map_body = map.keyframe(k).T_map_body;
    T_map_body = moves[static_cast<std::size_t>(k)] * T_map_body;
  }
}

}  // namespace vinebench
