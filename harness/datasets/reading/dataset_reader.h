// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "core/util/worker_pool.h"
#include "harness/datasets/reading/recording.h"

namespace vinebench::harness {

/// Reads a recording frame by frame, the cameras' images in grey. An image that is not there,
/// cannot be read or has a wrong size is empty, and an event. The truth at a frame is interpolated
/// between its neighbours in time where they are at most a quarter of a second apart.
class DatasetReader : public FrameSource {
 public:
  /// Keeps a reference to the pool, which reads the cameras' images side by side.
  DatasetReader(Recording recording, WorkerPool& pool);

  std::optional<Sample> next() override;
  std::int64_t size() const override { return static_cast<std::int64_t>(recording_.frames.size()); }
  const Rig& rig() const override { return recording_.rig; }
  const StageTimes& times() const override { return times_; }

 private:
  void read_images(const RecordedFrame& recorded, Sample& sample);

  Recording recording_;
  WorkerPool& pool_;
  std::size_t index_ = 0;
  std::size_t next_imu_ = 0;
  std::size_t next_wheels_ = 0;
  StageTimes times_;
};

/// The pose at that time: the nearest pose within a microsecond, otherwise interpolated. Empty
/// before the first, after the last, and in gaps longer than `max_gap`.
std::optional<Pose> pose_at(const Trajectory& trajectory, Stamp stamp, Stamp max_gap);

}  // namespace vinebench::harness
