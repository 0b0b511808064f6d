// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/slam_system.h"
#include "slam/map/map.h"

namespace vinebench::slam {

/// The body's pose in every frame, kept against a keyframe, so that it moves with the map's
/// corrections.
class TrajectoryRecord {
 public:
  /// A frame's pose in the map; `reckoned` if it is by dead reckoning alone.
  void add(Stamp stamp, const Keyframe& keyframe, const Pose& T_map_body, bool reckoned);

  /// Forgets what dead reckoning made of the frames that are kept against `keyframe`: the body was
  /// carried meanwhile.
  void withdraw_reckoned(int keyframe);

  /// The poses as the map's keyframes are now.
  Trajectory trajectory(const Map& map) const;

 private:
  struct Record {
    Stamp stamp;
    int keyframe;
    Pose T_keyframe_body;
    bool reckoned;
  };

  std::vector<Record> records_;
};

}  // namespace vinebench::slam
