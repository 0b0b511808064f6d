// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/pose.h"
#include "harness/datasets/ros/messages/ros_messages.h"

namespace vinebench::harness {

/// A pose of ROS, whose quaternion is close to unit length. Exact for an exact one.
Pose pose_of(const RosPose& pose);

/// How frames are mounted on each other (tf_static), by their names.
class TransformTree {
 public:
  /// Of two mounts of one frame the later counts.
  explicit TransformTree(const std::vector<RosTransform>& mounts);

  /// T_to_from; identity for a frame and itself, empty where nothing connects them.
  std::optional<Pose> between(const std::string& to, const std::string& from) const;

 private:
  struct Mount {
    std::string parent;
    Pose T_parent_child;
  };
  /// T_ancestor_frame of the frame and all above it, from below; ends where mounts go in a circle.
  std::vector<std::pair<std::string, Pose>> ancestors(const std::string& frame) const;

  std::map<std::string, Mount> mounts_;  ///< by the child's name
};

}  // namespace vinebench::harness
