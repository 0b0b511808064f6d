// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/runtime/mapping_scheduler.h"

#include <chrono>

namespace vinebench::slam {
namespace {

double solve(AdjustmentJob& job, const Map& map) {
  const auto start = std::chrono::steady_clock::now();
  job.solve();
  job.conclude(map);
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

}  // namespace

void MappingScheduler::start(std::unique_ptr<AdjustmentJob> job, int keyframe, const Map& map) {
  job_ = std::move(job);
  keyframe_ = keyframe;
  frames_since_start_ = 0;
  const bool at_once = schedule_ == MappingSchedule::kLockstep && (delay_ == 0 || in_caller_);
  solved_ = std::async(at_once ? std::launch::deferred : std::launch::async,
                       [job = job_.get(), &map] { return solve(*job, map); });
  if (at_once) solved_.wait();
}

bool MappingScheduler::due() const {
  if (!busy()) return false;
  if (schedule_ == MappingSchedule::kLockstep) return frames_since_start_ >= delay_;
  return solved_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

Pose MappingScheduler::join(Map& map, StageTimes& times) {
  if (!busy()) return {};
  times.add("local adjustment", solved_.get());
  const Pose before = map.keyframe(keyframe_).T_map_body;
  job_->apply(map);
  job_.reset();
  return map.keyframe(keyframe_).T_map_body * before.inverse();
}

}  // namespace vinebench::slam
