// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/truth/site.h"
#include "harness/run/sink.h"

namespace vinebench::harness {

/// What one tick leaves behind once its images are gone.
struct Tick {
  std::int64_t index = 0;
  Stamp stamp = 0;
  Truth truth;
  Estimate estimate;
  std::vector<SourceEvent> events;
  std::vector<bool> delivered{};  ///< whether each camera gave an image
};

/// A whole run, or as much of it as there was: the one input of judge, log, plot and metrics.
struct RunRecord {
  Rig rig;
  std::vector<WorldTag> tags;  ///< of the world, in its order
  std::vector<Tick> ticks;
  SlamSummary summary;
};

/// Whether this frame has a pose that the cameras bear out.
inline bool is_tracked(const Estimate& estimate) {
  return estimate.T_map_body.has_value() && estimate.status != TrackingStatus::kLost &&
         estimate.status != TrackingStatus::kDeadReckoning;
}

/// Where the truth is known.
Trajectory true_trajectory(const RunRecord& record);

/// Poses as they were known at their own frame.
Trajectory live_trajectory(const RunRecord& record);

/// Length of the true way from the first tick to each, m. Unknown poses add nothing.
std::vector<double> true_path_lengths(const RunRecord& record);

/// Fills a record. A system that gave no pose while it ran worked at the end alone: then the poses
/// of its trajectory are those of the frames with their stamps, and frames after the first one
/// without a pose are lost.
class RunRecorder : public Sink {
 public:
  RunRecorder(Rig rig, std::vector<WorldTag> tags);
  void on_tick(const Sample& sample, const Estimate& estimate) override;
  void on_finish(const SlamSummary& summary) override;
  const RunRecord& record() const { return record_; }

 private:
  RunRecord record_;
};

}  // namespace vinebench::harness
