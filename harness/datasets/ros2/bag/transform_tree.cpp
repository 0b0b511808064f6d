// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/bag/transform_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vinebench::harness {
namespace {

/// Names began with a slash in early versions of tf.
std::string plain(const std::string& frame) {
  return frame.starts_with('/') ? frame.substr(1) : frame;
}

// Above a frame; of a tree that is made to do harm the rest is not connected.
constexpr std::size_t kMostLevels = 256;

}  // namespace

Pose pose_of(const RosPose& pose) {
  const auto& [x, y, z, w] = pose.rotation;
  Eigen::Quaterniond rotation(w, x, y, z);
  // One of unit length within rounding is kept, so that a recording of ours gives the same bits.
  constexpr double kRounding = 1e-12;
  if (std::abs(rotation.squaredNorm() - 1) > kRounding) rotation.normalize();
  return {rotation, Eigen::Vector3d(pose.position.data())};
}

TransformTree::TransformTree(const std::vector<RosTransform>& mounts) {
  for (const RosTransform& mount : mounts) {
    mounts_[plain(mount.child)] = {plain(mount.header.frame), pose_of(mount.pose)};
  }
}

std::vector<std::pair<std::string, Pose>> TransformTree::ancestors(const std::string& frame) const {
  std::vector<std::pair<std::string, Pose>> line{{plain(frame), Pose{}}};
  while (line.size() <= std::min(mounts_.size(), kMostLevels)) {
    const auto mount = mounts_.find(line.back().first);
    if (mount == mounts_.end()) break;
    const Pose T_child_frame = line.back().second;
    const bool first = line.size() == 1;
    line.emplace_back(mount->second.parent, first ? mount->second.T_parent_child
                                                  : mount->second.T_parent_child * T_child_frame);
  }
  return line;
}

std::optional<Pose> TransformTree::between(const std::string& to, const std::string& from) const {
  const auto above_from = ancestors(from);
  for (const auto& [frame, T_frame_to] : ancestors(to)) {
    for (const auto& [other, T_other_from] : above_from) {
      if (other != frame) continue;
      return frame == plain(to) ? T_other_from : T_frame_to.inverse() * T_other_from;
    }
  }
  return std::nullopt;
}

}  // namespace vinebench::harness
