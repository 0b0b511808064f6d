// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/geometry/rig.h"
#include "core/truth/site.h"
#include "sim/world/terrain.h"

namespace vinebench::harness {

/// Tags in view of a rover if nothing occludes them.
class ClearView {
 public:
  /// The rig must outlive it.
  explicit ClearView(const Rig& rig);

  /// Indices into `tags`.
  std::vector<int> of(const std::vector<WorldTag>& tags, const Pose& T_world_body) const;

  /// Whether the camera, an index into Rig::tag_cameras, sees the tag.
  bool sees(std::size_t tag_camera, const WorldTag& tag, const Pose& T_world_body) const;

 private:
  const Rig& rig_;
  std::vector<cv::Mat> labels_;  ///< all tag, of each tag camera
};

/// The body at x, y (m) and heading (rad) on the ground there, without the suspension of wheels on
/// bumps.
Pose standing_at(const Eigen::Vector3d& pose, const sim::Terrain& terrain);

}  // namespace vinebench::harness
