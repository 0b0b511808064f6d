// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/util/stage_timer.h"
#include "slam/loop/adjusted_map.h"
#include "slam/loop/loop_closer.h"
#include "slam/runtime/background.h"

namespace vinebench::slam {

/// Global adjustments beside tracking, of a copy of the map, one at a time. What moves the map
/// meanwhile outdates the one that is under way: its result is dropped.
class GlobalAdjuster {
 public:
  /// Begins to adjust a copy of the map; where one is under way, another is wanted after it.
  void start(const LoopCloser& loop_closer, const EstimatorRig& rig, const Map& map);

  /// The map was moved by something else than local adjustments.
  void outdate() { outdated_ = busy(); }

  /// Whether another is wanted after the one under way.
  bool wants_another() const { return wanted_ || outdated_; }

  bool busy() const { return work_.busy(); }
  bool done() const { return work_.done(); }

  /// Waits for the adjustment and takes it over, once no local one is under way. Returns how the
  /// map's last keyframe moved (T_map_new T_map_old^-1); none where it was outdated. Its time is
  /// added to the stage "global adjustment".
  std::optional<Pose> join(Map& map, StageTimes& times);

 private:
  struct Work {
    AdjustedMap adjusted;
    double ms = 0;
  };

  Background<Work> work_;
  bool outdated_ = false;
  bool wanted_ = false;
};

}  // namespace vinebench::slam
