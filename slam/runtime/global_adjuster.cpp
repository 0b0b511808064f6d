// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/runtime/global_adjuster.h"

#include <chrono>
#include <memory>
#include <utility>

namespace vinebench::slam {

void GlobalAdjuster::start(const LoopCloser& loop_closer, const EstimatorRig& rig, const Map& map) {
  wanted_ = false;
  copy_ = std::async(std::launch::async, [&map] {
            return std::make_shared<Map>(copy_for_adjustment(map));
          }).share();
  // Copies: the loop closer learns, and self-calibration changes the rig.
  work_.start([closer = loop_closer, rig, copy = copy_] {
    Map& copied = *copy.get();
    const auto begin = std::chrono::steady_clock::now();
    AdjustedMap adjusted =
        adjust_copy(std::move(copied), [&](Map& m) { closer.adjust_globally(rig, m); });
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    return Work{std::move(adjusted), took.count()};
  });
}

void GlobalAdjuster::wait_for_copy() {
  if (copy_.valid()) copy_.wait();
  copy_ = {};
}

std::optional<Pose> GlobalAdjuster::join(Map& map, StageTimes& times) {
  wait_for_copy();
  const Work work = work_.take();
  times.add("global adjustment", work.ms);
  if (std::exchange(outdated_, false)) {
    wanted_ = true;
    return std::nullopt;
  }
  return take_over(work.adjusted, map);
}

}  // namespace vinebench::slam
