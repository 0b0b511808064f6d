// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/geometry/camera.h"
#include "core/geometry/pair_calibration.h"
#include "core/geometry/pose.h"

namespace vinebench::slam {

/// A camera on the body: its lens and where it sits; `baseline` is the right camera's distance
/// along the camera's x axis, m. The rest is what self-calibration finds (PairCalibration).
struct StereoCameraModel {
  PinholeCamera lens;
  Pose T_cam_body;
  double baseline = 0;
  double disparity_offset = 0;  ///< px
  double disparity_slope = 0;
  double time_offset = 0;  ///< s
  double readout = 0;      ///< s

  /// px that the disparities of a column are measured too small.
  double disparity_error(double x) const {
    return disparity_offset + disparity_slope * (x - lens.cx);
  }
  /// m along the optical axis, of a disparity (px) measured at a column.
  double depth_of(double x, double disparity) const {
    return lens.fx * baseline / (disparity + disparity_error(x));
  }
  /// px that a point in that depth (m) is measured at.
  double disparity_of(double x, double depth) const {
    return lens.fx * baseline / depth - disparity_error(x);
  }
  /// s after the stamp that a row is exposed.
  double time_of(double y) const { return time_offset + readout * (y / lens.height - 0.5); }
  bool has_times() const { return time_offset != 0 || readout != 0; }
};

/// A camera of a rig file as self-calibration has found it.
inline StereoCameraModel calibrated(const StereoCameraModel& nominal, const PairCalibration& pair) {
  StereoCameraModel camera = nominal;
  camera.T_cam_body = pair.T_nominal_camera.inverse() * nominal.T_cam_body;
  camera.lens.fx *= 1 + pair.focal;
  camera.lens.fy *= 1 + pair.focal;
  camera.baseline *= 1 + pair.baseline;
  camera.disparity_offset = pair.disparity_offset;
  camera.disparity_slope = pair.disparity_slope;
  camera.time_offset = pair.time;
  camera.readout = pair.readout;
  return camera;
}

}  // namespace vinebench::slam
