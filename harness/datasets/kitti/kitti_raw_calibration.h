// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <opencv2/core/types.hpp>
#include <optional>

#include "core/geometry/rig.h"

namespace vinebench::harness {

/// Calibration of a day of KITTI's raw data: A. Geiger, P. Lenz, C. Stiller and R. Urtasun, "Vision
/// meets Robotics: The KITTI Dataset", IJRR 2013, section 4. Its frames are those of the cameras:
/// x right, y down, z ahead.
class KittiRawCalibration {
 public:
  /// Of cameras `left` and `right` (0 to 3), from calib_cam_to_cam.txt in a folder. `images` is
  /// the size of their images, which tells whether they are rectified. Throws Error with file and
  /// line.
  KittiRawCalibration(const std::filesystem::path& folder, int left, int right, cv::Size images);

  bool rectified() const { return rectified_; }
  /// Left and right, on a body at camera 0.
  const RigCamera& camera(std::size_t which) const { return cameras_[which]; }

  /// Pose of the inertial unit in camera 0 as it is (not rectified), from calib_imu_to_velo.txt and
  /// calib_velo_to_cam.txt; none unless both are there.
  static std::optional<Pose> inertial_unit(const std::filesystem::path& folder);

 private:
  bool rectified_ = false;
  std::array<RigCamera, 2> cameras_;
};

}  // namespace vinebench::harness
