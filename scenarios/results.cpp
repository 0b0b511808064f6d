// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "scenarios/results.h"

namespace vinebench {
namespace {

void count_losses(const RunRecord& record, RunResults& results) {
  int tracked_frames = 0;
  bool had_pose = false;
  for (const Tick& tick : record.ticks) {
    const bool tracked = is_tracked(tick.estimate);
    if (tracked) ++tracked_frames;
    if (had_pose && !tracked) ++results.losses;
    if (!tracked && tracked_frames > 0) ++results.lost_frames;
    had_pose = tracked;
  }
  if (!record.ticks.empty()) {
    results.coverage = tracked_frames / static_cast<double>(record.ticks.size());
  }
}

}  // namespace

RunResults measure(const RunRecord& record, const Expectations& expectations) {
  RunResults results;
  count_losses(record, results);
  const Trajectory truth = true_trajectory(record);
  results.corrected = evaluate(truth, record.summary.trajectory);
  results.live = evaluate(truth, live_trajectory(record));
  results.loops = judge_loop_closures(record);
  if (const auto& blind = expectations.blind) {
    results.blind =
        longest_blind_stretch(record, find_cameras(record.rig, blind->cameras), blind->box_share);
  }
  return results;
}

}  // namespace vinebench
