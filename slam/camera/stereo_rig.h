// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/rig.h"

namespace vinebench::slam {

class Rectification;

/// A rectified pair as the estimator uses it: one lens, two cameras on one row. Of a pair whose
/// images must be rectified first, these are the virtual cameras'.
struct RectifiedPair {
  std::string name;
  int left_camera = 0;  ///< index into Rig::cameras
  int right_camera = 0;
  PinholeCamera lens;   ///< of both cameras
  double baseline = 0;  ///< m
  Pose T_body_cam;      ///< left camera
  Pose T_cam_body;
  std::shared_ptr<const Rectification> rectification;  ///< none where the images are rectified
};

/// The part of a rig that is in use: pairs for tracking, cameras for tags.
struct StereoRig {
  std::vector<RectifiedPair> pairs;
  std::vector<int> tag_cameras;    ///< indices into Rig::cameras
  std::vector<RigCamera> cameras;  ///< all of the rig's
  std::optional<ImuNoise> imu;     ///< of its inertial unit, where it is known
};

/// Selects the pairs and tag cameras that `names` lists (all where it is empty). Throws Error for
/// an unknown name, when no pair is left, and for a pair that cannot be rectified. A pair of equal
/// lenses without distortion whose cameras are parallel and side by side, to a hundredth of a
/// pixel, is used as it is.
StereoRig make_stereo_rig(const Rig& rig, const std::vector<std::string>& names);

}  // namespace vinebench::slam
