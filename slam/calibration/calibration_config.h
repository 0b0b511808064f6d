// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/config/config_field.h"

namespace vinebench::slam {

/// Accuracy of the stereo pairs' calibrations as the rig file has them: standard deviations of the
/// numbers of PairCalibration; that of disparity offsets is StereoConfig::calibration_sigma.
struct CalibrationConfig {
  double position = 0.005;               ///< m
  double rotation_deg = 0.3;             ///< degrees
  double disparity_slope = 0.002;        ///< share of the focal length
  double focal = 0.002;                  ///< share
  double baseline = 0.003;               ///< share
  double time = 0.005;                   ///< s
  double readout = 0.02;                 ///< s
  double principal_point = 1;            ///< px
  double right_turn_deg = 0.1;           ///< degrees
  double right_ahead = 0.003;            ///< share of the baseline
  double tag_size = 0.001;               ///< share, of the sides of tags
  double tag_camera_position = 0.002;    ///< m, of the cameras that see tags
  double tag_camera_rotation_deg = 0.1;  ///< degrees, likewise
  double tag_camera_time = 0.005;        ///< s, likewise

  template <class Archive>
  void serialize(Archive& archive) {
    archive("position", position, Range::positive());
    archive("rotation_deg", rotation_deg, Range::positive());
    archive("disparity_slope", disparity_slope, Range::positive());
    archive("focal", focal, Range::positive());
    archive("baseline", baseline, Range::positive());
    archive("time", time, Range::positive());
    archive("readout", readout, Range::positive());
    archive("principal_point", principal_point, Range::positive());
    archive("right_turn_deg", right_turn_deg, Range::positive());
    archive("right_ahead", right_ahead, Range::positive());
    archive("tag_size", tag_size, Range::positive());
    archive("tag_camera_position", tag_camera_position, Range::positive());
    archive("tag_camera_rotation_deg", tag_camera_rotation_deg, Range::positive());
    archive("tag_camera_time", tag_camera_time, Range::positive());
  }
};

}  // namespace vinebench::slam
