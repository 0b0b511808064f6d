// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/runtime/global_adjuster.h"

#include <chrono>
#include <memory>
#include <utility>

namespace vinebench::slam {

void GlobalAdjuster::start(const LoopCloser& loop_closer, const EstimatorRig& rig, const Map& map) {
  if (busy()) {
    wanted_ = true;
    return;
  }
  // Copies: the loop closer learns, and self-calibration changes the rig.
  work_.start([closer = loop_closer, rig, copy = std::make_shared<Map>(copy_for_adjustment(map))] {
    const auto begin = std::chrono::steady_clock::now();
    AdjustedMap adjusted =
        adjust_copy(std::move(*copy), [&](Map& m) { closer.adjust_globally(rig, m); });
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    return Work{std::move(adjusted), took.count()};
  });
}

std::optional<Pose> GlobalAdjuster::join(Map& map, StageTimes& times) {
  const Work work = work_.take();
  times.add("global adjustment", work.ms);
  wanted_ = false;
  if (std::exchange(outdated_, false)) return std::nullopt;
  return take_over(work.adjusted, map);
}

}  // namespace vinebench::slam
