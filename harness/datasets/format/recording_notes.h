// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/frame.h"
#include "core/geometry/rig.h"
#include "core/slam_system.h"
#include "core/truth/site.h"
#include "slam/config.h"

namespace vinebench::harness {

/// The metadata of a recording.
struct RecordingNotes {
  RigConfig rig;  ///< the nominal rig
  std::vector<RegisteredTag> tags;
  slam::SlamConfig slam;
  double imu_rate_hz = 200;
  ImuNoise imu;                              ///< zero where the unit has none
  std::optional<ImuSample> first_reading{};  ///< inertial, before those of the first frame
  std::string scenario;                      ///< name
  std::string world;                         ///< name
  std::int64_t seed = 0;
  std::string settings;              ///< the scenario with all defaults resolved, YAML
  std::vector<WorldTag> world_tags;  ///< indexed by Truth::visible_tags
  /// The true cameras, in the rig's order: they differ from it by the calibration error.
  std::vector<RigCamera> true_cameras;
};

/// The metadata with these cameras only, in the rig's order, with the remaining complete pairs and
/// tag cameras. All if no name is given. Throws Error for a name that the rig does not have.
RecordingNotes with_cameras(RecordingNotes notes, const std::vector<std::string>& names);

}  // namespace vinebench::harness
