// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <optional>

#include "core/util/stage_timer.h"
#include "slam/mapping/mapping_config.h"
#include "slam/optimisation/bundle_adjustment.h"

namespace vinebench::slam {

/// Runs local adjustments beside tracking, one at a time, on a thread of their own.
class MappingScheduler {
 public:
  /// With `in_caller`, jobs of the lockstep are solved by the caller, with the same results: there
  /// is never another thread.
  explicit MappingScheduler(const MappingConfig& config, bool in_caller = false)
      : schedule_(config.schedule), delay_(config.delay), in_caller_(in_caller) {}

  /// Begins to solve a job that moves `keyframe` among others. None may be under way. Until join()
  /// nobody else may change keyframes and landmarks of the map that it was made of. With a delay of
  /// no frames in lockstep, and in the caller, it is solved before this returns.
  void start(std::unique_ptr<AdjustmentJob> job, int keyframe, const Map& map);

  /// Counts a frame.
  void tick() { ++frames_since_start_; }

  bool busy() const { return job_ != nullptr; }

  /// Whether the job's result is to be taken over now: in lockstep after the delay, live when it is
  /// there.
  bool due() const;

  /// The job under way is to end soon, with what it has found by then, which is no longer the same
  /// each time.
  void hasten() { job_->stop(); }

  /// Waits for the job, writes its result into the map, adds its time to the stage "local
  /// adjustment". Returns how the keyframe that it was started for moved: T_map_new T_map_old^-1.
  /// Does nothing where there is no job.
  Pose join(Map& map, StageTimes& times);

 private:
  MappingSchedule schedule_;
  int delay_;
  bool in_caller_;
  std::unique_ptr<AdjustmentJob> job_;
  std::future<double> solved_;  ///< ms it took
  int keyframe_ = 0;
  int frames_since_start_ = 0;
};

}  // namespace vinebench::slam
