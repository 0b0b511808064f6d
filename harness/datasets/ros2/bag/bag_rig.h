// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/ros2/bag/bag_cameras.h"
#include "harness/datasets/ros2/bag/transform_tree.h"

namespace vinebench::harness {

/// A rig from CameraInfo and /tf_static.
struct BagRig {
  Rig rig;
  /// T_body_frame of a frame of ROS; the body is base_link where that carries the first camera,
  /// else at that camera, x ahead, y left, z up.
  std::optional<Pose> body_from(const std::string& frame) const;

  TransformTree mounts{{}};
  std::string reference;  ///< frame that T_body_reference belongs to
  Pose T_body_reference;
};

/// Throws Error where there is no pair, and, with the topic, for a calibration that is absent or
/// cannot be used: another lens than a pinhole with k1, k2, p1, p2, sizes beyond a rig's, no
/// baseline.
BagRig read_bag_rig(const BagContents& contents, const BagCameras& cameras);

/// The places of frames alone: where a rig file has the cameras, the body is to be set by it, as
/// T_body_reference of the first camera.
BagRig place_frames(const BagContents& contents, const BagCameras& cameras);

}  // namespace vinebench::harness
