// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/camera_check.h"

#include "core/util/error.h"

namespace vinebench::sim {

void check_camera(const PinholeCamera& camera) {
  if (camera.has_distortion()) {
    fail("renderer: the camera has lens distortion, expected an ideal pinhole");
  }
  if (camera.width < 1 || camera.height < 1 || camera.width > kLargestImage ||
      camera.height > kLargestImage) {
    fail("renderer: an image of {} x {} pixels, expected 1 to {} a side", camera.width,
         camera.height, kLargestImage);
  }
  if (!(camera.fx > 0) || !(camera.fy > 0)) {
    fail("renderer: focal lengths of {} and {} px, expected more than 0", camera.fx, camera.fy);
  }
}

}  // namespace vinebench::sim
