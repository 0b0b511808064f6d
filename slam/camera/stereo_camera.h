// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/geometry/camera.h"
#include "core/geometry/pose.h"

namespace vinebench::slam {

/// A camera on the body: its lens and where it sits; `baseline` is the right camera's distance
/// along the camera's x axis, m.
struct StereoCameraModel {
  PinholeCamera lens;
  Pose T_cam_body;
  double baseline = 0;
  double disparity_offset =
      0;  ///< px that disparities measure too little, by the pair's calibration

  /// m along the optical axis, of a measured disparity (px).
  double depth_of(double disparity) const {
    return lens.fx * baseline / (disparity + disparity_offset);
  }
  /// px that a point in that depth (m) is measured at.
  double disparity_of(double depth) const { return lens.fx * baseline / depth - disparity_offset; }
};

}  // namespace vinebench::slam
