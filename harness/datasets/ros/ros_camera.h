// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/geometry/rig.h"
#include "harness/datasets/ros/messages/ros_messages.h"

namespace vinebench::harness {

/// A camera of the rig in ROS.
struct RosCamera {
  std::string frame;  ///< "<name>_optical_frame"
  std::string
      images;        ///< topic: "/<name>/image_rect" of an ideal pinhole, else "/<name>/image_raw"
  std::string info;  ///< topic: "/<name>/camera_info"
  RosCameraInfo calibration;
};

/// For a pair that is not rectified, R and P are those of the SLAM core's rectified view. Throws
/// Error for a name that is invalid in a ROS topic, and a pair that cannot be rectified.
std::vector<RosCamera> ros_cameras(const Rig& rig);

}  // namespace vinebench::harness
