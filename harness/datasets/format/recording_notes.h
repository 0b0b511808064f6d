// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "harness/experiment/scenario.h"

namespace vinebench {

/// What a recording keeps beside the frames.
struct RecordingNotes {
  RigConfig rig;  ///< as the SLAM system is told of it
  std::vector<RegisteredTag> tags;
  SlamConfig slam;
  double imu_rate_hz = 200;
  InertialSensorConfig imu;
  std::string comment;                       ///< for body.yaml
  std::vector<WorldConfig::Tag> world_tags;  ///< what Truth::visible_tags counts
  /// The cameras that take the images, in the rig's order: they differ from it by the calibration
  /// error.
  std::vector<RigCamera> true_cameras;
};

/// The notes of a scenario's run. Throws Error when the rig's file cannot be read.
RecordingNotes notes_of(const ScenarioConfig& scenario);

/// The notes with these cameras alone, in the rig's order, the pairs both of whose cameras are
/// left, and tag cameras. All where no name is given. Throws Error for a name that the rig has not.
RecordingNotes with_cameras(RecordingNotes notes, const std::vector<std::string>& names);

}  // namespace vinebench
