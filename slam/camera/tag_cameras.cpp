// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/camera/tag_cameras.h"

namespace vinebench::slam {

TagCameras::TagCameras(const std::vector<RigCamera>& rig_cameras) : cameras(rig_cameras) {
  for (const RigCamera& camera : cameras) {
    undistorted.push_back({camera.model.without_distortion(), camera.T_body_cam.inverse(), 0});
  }
}

}  // namespace vinebench::slam
