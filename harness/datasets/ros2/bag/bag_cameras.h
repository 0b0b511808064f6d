// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/geometry/rig.h"
#include "harness/datasets/ros2/bag/bag_contents.h"

namespace vinebench::harness {

/// A camera of a bag: one topic of images.
struct BagCamera {
  std::string name;        ///< the last part of its namespace: "left" of "/left/image_rect"
  std::string topic;       ///< of images
  std::string info;        ///< topic of its calibration
  bool rectified = false;  ///< by its topic's name
};

/// Cameras of a replay, those of pairs first.
struct BagCameras {
  std::vector<BagCamera> cameras;
  std::vector<StereoPair> pairs;
};

/// With topics, these cameras: the first two are a pair, and of four or more the next two; without,
/// one topic of each namespace that has images, pairs by "left" and "right" and the like in their
/// names (docs/replay.md). Throws Error where there is no camera, or not those that are named.
BagCameras choose_bag_cameras(const BagContents& contents, const std::vector<std::string>& topics);

/// Throws Error that lists the bag's topics.
[[noreturn]] void fault_without_pair(const BagContents& contents);

/// Puts cameras into the order of a rig where each of the rig's has its name; unchanged otherwise.
void order_by_rig(const Rig& rig, std::vector<BagCamera>& cameras);

}  // namespace vinebench::harness
