// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/geometry/rig.h"
#include "core/slam_system.h"
#include "core/truth/site.h"
#include "slam/config.h"

namespace vinebench::harness {

/// Noise of an inertial unit as calibration files have it (unit u = rad/s or m/s^2).
struct ImuNoise {
  struct Axes {
    double noise_density = 0;     ///< u/sqrt(Hz)
    double bias_random_walk = 0;  ///< u/s/sqrt(Hz)
  };
  Axes gyroscope;
  Axes accelerometer;
};

/// What a recording keeps beside the frames.
struct RecordingNotes {
  RigConfig rig;  ///< as the SLAM system is told of it
  std::vector<RegisteredTag> tags;
  slam::SlamConfig slam;
  double imu_rate_hz = 200;
  ImuNoise imu;
  std::string scenario;  ///< its name
  std::string world;     ///< its name
  std::int64_t seed = 0;
  std::string settings;              ///< the scenario with all defaults resolved, YAML
  std::vector<WorldTag> world_tags;  ///< what Truth::visible_tags counts
  /// The cameras that take the images, in the rig's order: they differ from it by the calibration
  /// error.
  std::vector<RigCamera> true_cameras;
};

/// The notes with these cameras alone, in the rig's order, the pairs both of whose cameras are
/// left, and tag cameras. All where no name is given. Throws Error for a name that the rig has not.
RecordingNotes with_cameras(RecordingNotes notes, const std::vector<std::string>& names);

}  // namespace vinebench::harness
