// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/geometry/rig.h"
#include "slam/camera/stereo_camera.h"

namespace vinebench::slam {

/// The cameras of a rig as tags are seen by them, by index into Rig::cameras.
struct TagCameras {
  explicit TagCameras(const std::vector<RigCamera>& rig_cameras);

  std::vector<RigCamera> cameras;
  std::vector<StereoCameraModel> undistorted;  ///< the same without distortion; no baseline
};

}  // namespace vinebench::slam
