// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "slam/base/rig.h"

namespace vinebench {

/// A rectified pair as the estimator uses it: one lens, two eyes on one row.
struct StereoEye {
  std::string name;
  int left_camera = 0;  ///< index into Rig::cameras
  int right_camera = 0;
  PinholeCamera lens;   ///< of both eyes
  double baseline = 0;  ///< m
  Pose T_body_cam;      ///< left eye
  Pose T_cam_body;
};

/// The part of a rig that is in use: pairs for tracking, cameras for tags.
struct StereoRig {
  std::vector<StereoEye> pairs;
  std::vector<int> tag_cameras;    ///< indices into Rig::cameras
  std::vector<RigCamera> cameras;  ///< all of the rig's
};

/// Selects the pairs and tag cameras that `names` lists (all where it is empty). Throws Error for
/// an unknown name, when no pair is left, and for a pair that is not rectified: different or
/// distorted lenses, eyes not parallel or not side by side.
StereoRig make_stereo_rig(const Rig& rig, const std::vector<std::string>& names);

}  // namespace vinebench
