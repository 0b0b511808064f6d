// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "core/trajectory.h"
#include "harness/datasets/files/append_file.h"
#include "harness/datasets/format/format_writer.h"

namespace vinebench::harness {

/// EuRoC/ASL: mav0 with cam0, cam1, … in the order of the rig (grey or RGB, PNG; names of 19
/// digits, which sort by time), imu0, wheels0, state_groundtruth_estimate0 (at the inertial unit's
/// rate and at the frames' stamps); beside mav0 times.txt (ns of the frames with images of both
/// cameras of the first pair, for ORB-SLAM3), settings for other SLAM systems, and our extensions:
/// frames.csv (stamps of all frames, because a camera may lack one), rig.yaml, tags.yaml,
/// slam.yaml.
class EurocWriter : public FormatWriter {
 public:
  EurocWriter(const std::filesystem::path& folder, const RecordingNotes& notes, bool colour);

  std::vector<FileTask> files(const std::shared_ptr<const DatasetFrame>& frame) override;
  void commit(const DatasetFrame& frame) override;
  /// A true pose is written with a later one, because its velocity needs both.
  void finish() override;

 private:
  void describe(const std::filesystem::path& folder, const RecordingNotes& notes) const;
  /// A line of the truth that waits for the next support, a pose that velocities are taken from.
  struct PendingPose {
    StampedPose at;
    StampedPose from;  ///< support before it
  };

  void write_readings(const Frame& frame);
  void add_truth(const DatasetFrame& frame);
  void add_support(const StampedPose& support);
  ImuBias bias_at(Stamp stamp);
  void append_truth(const StampedPose& at, const StampedPose& from, const StampedPose& to);

  std::filesystem::path mav_;
  bool colour_;
  std::optional<StereoPair> pair_;  ///< the first
  AppendFile frames_;
  AppendFile times_;
  AppendFile imu_;
  AppendFile wheels_;
  AppendFile truth_;
  std::vector<AppendFile> cameras_;
  std::vector<PendingPose> pending_;
  std::optional<StampedPose> support_;  ///< the latest
  std::optional<StampedPose> before_;   ///< the one before it
  std::deque<ImuBias> biases_;          ///< those of truth that is not written yet
};

}  // namespace vinebench::harness
