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
  Eigen::Vector3d right_turn = Eigen::Vector3d::Zero();  ///< rad
  double right_ahead = 0;                                ///< share of the baseline
  double time_offset = 0;                                ///< s
  double readout = 0;                                    ///< s

  /// px that the disparity of what is seen at a pixel of the left camera is measured too small.
  /// What the right camera's place ahead makes of it, of a disparity, comes to that.
  double disparity_error(const Eigen::Vector2d& pixel, double disparity) const {
    const double right = (pixel.x() - lens.cx - disparity) / lens.fx;  // slope of the right ray
    const double down = (pixel.y() - lens.cy) / lens.fy;
    return disparity_offset +
           lens.fx * (disparity_slope * right + right_turn.x() * right * down -
                      right_turn.y() * right * right + right_turn.z() * down) +
           right_ahead * disparity * right;
  }
  /// m along the optical axis, of a disparity (px) measured at a pixel.
  double depth_of(const Eigen::Vector2d& pixel, double disparity) const {
    const double near = disparity + disparity_error(pixel, disparity);
    return lens.fx * baseline / (disparity + disparity_error(pixel, near));
  }
  /// px that a point in that depth (m) is measured at.
  double disparity_of(const Eigen::Vector2d& pixel, double depth) const {
    const double disparity = lens.fx * baseline / depth;
    return disparity - disparity_error(pixel, disparity);
  }
  bool has_disparity_errors() const {
    return disparity_offset != 0 || disparity_slope != 0 || !right_turn.isZero(0) ||
           right_ahead != 0;
  }
  /// s after the stamp that a row is exposed.
  double time_of(double y) const { return time_offset + readout * share_of_readout(y); }
  /// Of the time from the first row to the last, from the middle one on.
  double share_of_readout(double y) const { return y / lens.height - 0.5; }
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
  camera.lens.cx += pair.principal_point.x();
  camera.lens.cy += pair.principal_point.y();
  camera.right_turn = pair.right_turn;
  camera.right_ahead = pair.right_ahead;
  camera.time_offset = pair.time;
  camera.readout = pair.readout;
  return camera;
}

}  // namespace vinebench::slam
