// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <future>
#include <memory>
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
  /// The map is to be adjusted, as it is once none is under way.
  void want() { wanted_ = true; }

  /// The map was moved by something else than local adjustments.
  void outdate() { outdated_ = busy(); }

  /// Whether one is to be started.
  bool due() const { return wanted_ && !busy(); }

  /// Begins to adjust a copy of the map, as it was wanted. None may be under way. The map is read
  /// until wait_for_copy() has returned: it must not be changed before.
  void start(const LoopCloser& loop_closer, const EstimatorRig& rig, const Map& map);
  void wait_for_copy();

  bool busy() const { return work_.busy(); }
  bool done() const { return work_.done(); }

  /// Waits for the adjustment and takes it over, once no local one is under way. Returns how the
  /// map's last keyframe moved (T_map_new T_map_old^-1); none where it was outdated, so that
  /// another is wanted. Its time is added to the stage "global adjustment".
  std::optional<Pose> join(Map& map, StageTimes& times);

 private:
  struct Work {
    AdjustedMap adjusted;
    double ms = 0;
  };

  std::shared_future<std::shared_ptr<Map>> copy_;
  Background<Work> work_;
  bool outdated_ = false;
  bool wanted_ = false;
};

}  // namespace vinebench::slam
