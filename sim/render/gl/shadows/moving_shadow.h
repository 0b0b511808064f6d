// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "core/geometry/camera.h"
#include "core/geometry/pose.h"
#include "sim/render/gl/scene/gpu_scene.h"

namespace vinebench::sim {

/// Depth of what moves alone as seen from the sun, drawn again whenever it has moved: one map,
/// fitted around all whose shadows may be in view.
class MovingShadow {
 public:
  /// `size` pixels a side at most; 0 casts no shadow.
  MovingShadow(const GpuScene& scene, int size);

  /// Draws the map of those whose shadow may be in view; says whether there are any. Leaves another
  /// target bound.
  bool cast(const GpuScene& scene, const std::vector<Mover>& movers, const PinholeCamera& camera,
            const Pose& T_world_cam);

  /// Whether the last shadows cast may fall on some of a ball; world frame, m.
  bool may_shade(const Eigen::Vector3d& centre, double radius) const;

  const GlTexture& texture() const { return texture_; }
  /// World to the map's texture coordinates and depth, all 0 to 1.
  Eigen::Matrix4d map_from_world() const;

 private:
  bool may_be_seen(const Mover& mover, const PinholeCamera& camera, const Pose& T_world_cam) const;
  void draw(const GpuScene& scene, const std::vector<Mover>& casters) const;

  bool casts_;
  Eigen::Vector3d towards_sun_;
  Eigen::Matrix3d R_sun_world_;
  int size_;
  GlTexture texture_;
  GlFramebuffer framebuffer_;
  GlProgram program_;
  std::vector<Mover> drawn_;  ///< those in the map
  Eigen::AlignedBox3d box_;   ///< around them, in the sun's axes
};

}  // namespace vinebench::sim
