// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/time.h"

namespace vinebench {

/// One reading of the inertial unit, in the body frame.
struct ImuSample {
  Stamp stamp = 0;
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  ///< rad/s
  Eigen::Vector3d specific_force = Eigen::Vector3d::Zero();    ///< m/s^2; +9.81 along z at rest
};

/// One reading of the wheel encoders: front-left, front-right, rear-left, rear-right.
struct WheelSample {
  Stamp stamp = 0;
  std::array<double, 4> angle{};     ///< rad, accumulated
  std::array<double, 4> velocity{};  ///< rad/s
};

/// The sensor data of one instant: the complete input of a SLAM system.
struct Frame {
  std::int64_t index = 0;
  Stamp stamp = 0;
  /// One image for each camera, in the rig's order; CV_8UC1 (grey) or CV_8UC3 (RGB), top row first.
  /// Empty if the camera delivered none.
  std::vector<cv::Mat> images;
  /// When each image was taken, where they have stamps of their own; empty: all at `stamp`.
  std::vector<Stamp> image_stamps{};
  std::vector<ImuSample> imu;       ///< since the previous frame, oldest first
  std::vector<WheelSample> wheels;  ///< since the previous frame, oldest first

  Stamp image_stamp(std::size_t camera) const {
    return image_stamps.empty() ? stamp : image_stamps[camera];
  }
};

}  // namespace vinebench
