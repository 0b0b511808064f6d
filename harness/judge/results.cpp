// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/results.h"

#include <limits>

namespace vinebench::harness {
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

/// When the first loop closure is reported; after all frames if there is none.
Stamp first_closure(const RunRecord& record) {
  for (const Tick& tick : record.ticks) {
    if (tick.estimate.loop_closure) return tick.stamp;
  }
  return std::numeric_limits<Stamp>::max();
}

/// Of the frames with a pose by cameras whose place in the world was told with it.
std::optional<WorldErrors> live_world_errors(const RunRecord& record) {
  std::vector<PosePair> pairs;
  for (const Tick& tick : record.ticks) {
    const Estimate& estimate = tick.estimate;
    if (!is_tracked(estimate) || !estimate.T_world_map || !tick.truth.known) continue;
    pairs.push_back(
        {tick.stamp, tick.truth.T_world_body, *estimate.T_world_map * *estimate.T_map_body});
  }
  if (pairs.empty()) return std::nullopt;
  return WorldErrors{position_errors(pairs, {}), orientation_errors(pairs, {})};
}

std::optional<double> end_error(const RunRecord& record,
                                const std::optional<Eigen::Vector2d>& route_end) {
  if (record.ticks.empty() || !record.ticks.back().truth.known) return std::nullopt;
  if (!route_end) return std::nullopt;
  const Eigen::Vector3d& end = record.ticks.back().truth.T_world_body.translation;
  return (end.head<2>() - *route_end).norm();
}

}  // namespace

RunResults measure(const RunRecord& record, const Trial& trial) {
  RunResults results;
  count_losses(record, results);
  const Trajectory truth = true_trajectory(record);
  const Trajectory live = live_trajectory(record);
  results.corrected = evaluate(truth, record.summary.trajectory, record.summary.T_world_map);
  results.live = evaluate(truth, live);
  results.live_world = live_world_errors(record);
  results.drift = drift_before(first_closure(record), truth, live);
  results.consistency = check_consistency(record);
  results.end_error = end_error(record, trial.route_end);
  results.loops = judge_loop_closures(record);
  if (const Expectations::Blind* blind = trial.blind()) {
    results.blind =
        longest_occlusion(record, find_cameras(record.rig, blind->cameras), blind->box_share);
  }
  return results;
}

}  // namespace vinebench::harness
