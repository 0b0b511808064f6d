// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "scenarios/scenario.h"
#include "scenarios/sink.h"

namespace vinebench {

/// What a recording keeps beside the frames.
struct RecordingNotes {
  RigConfig rig;  ///< as the SLAM system is told of it
  std::vector<RegisteredTag> tags;
  SlamConfig slam;
  double imu_rate_hz = 200;
  InertialSensorConfig imu;
  std::string comment;  ///< for body.yaml
};

/// The notes of a scenario's run. Throws Error when the rig's file cannot be read.
RecordingNotes notes_of(const ScenarioConfig& scenario);

/// Writes a run as an EuRoC/ASL folder: mav0 with cam0, cam1, … in the order of the rig (grey PNG),
/// imu0, wheels0, state_groundtruth_estimate0; and beside mav0 what is ours: frames.csv (stamps of
/// all frames, for a camera may miss one), rig.yaml, tags.yaml, slam.yaml. A replay of it gives the
/// run's estimate to the bit. Encodes on a thread of its own with few frames waiting; a frame is in
/// the lists once its pictures are whole, so that an interrupted recording can be read.
class EurocWriter : public Sink {
 public:
  /// Throws Error for a folder that is not empty or cannot be written to. Writing frames throws
  /// when the disk is full.
  EurocWriter(const std::filesystem::path& folder, const RecordingNotes& notes);
  ~EurocWriter() override;

  void on_tick(const Sample& sample, const Estimate& estimate) override;
  void on_finish(const SlamSummary& summary) override;

 private:
  class Files;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vinebench
