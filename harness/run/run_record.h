// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "core/truth/site.h"
#include "harness/run/sink.h"

namespace vinebench::harness {

/// How bright an image is, by its codes (0 to 255, of all channels).
struct Brightness {
  double dark = 0;       ///< share of those below 64, a quarter of the range
  double saturated = 0;  ///< share of those of 250 and more
};
/// Over every fourth row; zeros for an empty image.
Brightness brightness_of(const cv::Mat& image);

/// The record of one tick, without images.
struct Tick {
  std::int64_t index = 0;
  Stamp stamp = 0;
  Truth truth;
  Estimate estimate;
  std::vector<SourceEvent> events;
  std::vector<bool> delivered{};         ///< whether each camera delivered an image
  std::vector<Brightness> brightness{};  ///< of each camera's image
};

/// A run, or its part up to an interruption: the only input of evaluation, log, plot and metrics.
struct RunRecord {
  Rig rig;
  std::vector<WorldTag> tags;              ///< of the world, in its order
  std::vector<RegisteredTag> told_tags{};  ///< to the system, where those of the world are unknown
  std::vector<Tick> ticks;
  SlamSummary summary;
  std::optional<SlamFailure> failure{};  ///< of the system under test
};

/// Whether this frame has a pose supported by the cameras.
inline bool is_tracked(const Estimate& estimate) {
  return estimate.T_map_body.has_value() && estimate.status != TrackingStatus::kLost &&
         estimate.status != TrackingStatus::kDeadReckoning;
}

/// The ticks with known truth.
Trajectory true_trajectory(const RunRecord& record);

/// Live poses.
Trajectory live_trajectory(const RunRecord& record);

/// Length of the true path from the first tick to each, m. Unknown poses add nothing.
std::vector<double> true_path_lengths(const RunRecord& record);

/// Fills a record. If a system gave no pose during the run, it ran after the last frame: the poses
/// of its trajectory are then assigned to frames by stamp, and frames without a pose after the
/// first one with a pose are lost.
class RunRecorder : public Sink {
 public:
  RunRecorder(Rig rig, std::vector<WorldTag> tags, std::vector<RegisteredTag> told_tags = {});
  void on_tick(const Sample& sample, const Estimate& estimate) override;
  void on_failure(const SlamFailure& failure) override { record_.failure = failure; }
  void on_finish(const SlamSummary& summary) override;
  const RunRecord& record() const { return record_; }

 private:
  RunRecord record_;
};

}  // namespace vinebench::harness
