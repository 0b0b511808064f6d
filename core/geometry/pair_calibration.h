// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/geometry/pose.h"

namespace vinebench {

/// By what a stereo pair differs from its rig file and from what its stamps say.
struct PairCalibration {
  Pose T_nominal_camera;  ///< the left camera, from where the rig file has it
  /// px that the right camera sees everything too far to the right.
  double disparity_offset = 0;
  /// The same in px for each px to the right of the principal point: the eyes differ in focal
  /// length by this share.
  double disparity_slope = 0;
  double focal = 0;     ///< share that the focal length is longer
  double baseline = 0;  ///< share that the baseline is longer
  double time = 0;      ///< s that images are taken later than they are stamped, at half height
  double readout = 0;   ///< s from the first row to the last
  /// px that the principal points of both cameras are to the right and below.
  Eigen::Vector2d principal_point = Eigen::Vector2d::Zero();
  /// rad that the right camera is turned by about the left one's axes, beside what disparity_offset
  /// has of it in the middle of the image.
  Eigen::Vector3d right_turn = Eigen::Vector3d::Zero();
  double right_ahead = 0;  ///< share of the baseline that the right camera is ahead of the left one
};

}  // namespace vinebench
