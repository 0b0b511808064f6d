// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "core/geometry/camera.h"
#include "core/geometry/pose.h"
#include "sim/render/gl/scene/gpu_scene.h"

namespace vinebench::sim {

/// Depth of the rover alone as seen from the sun, drawn anew for each place of the rover.
class RoverShadow {
 public:
  /// `size` pixels a side; 0 casts no shadow.
  RoverShadow(const GpuScene& scene, int size);

  /// Draws the map for a rover there, unless its shadow cannot be in view; says whether it may be.
  /// Leaves another target bound.
  bool cast(const GpuScene& scene, const Pose& T_world_rover, const PinholeCamera& camera,
            const Pose& T_world_cam);

  /// Whether the last shadow cast may fall on some of a ball; world frame, m.
  bool may_shade(const Eigen::Vector3d& centre, double radius) const;

  const GlTexture& texture() const { return texture_; }
  /// World to the map's texture coordinates and depth, all 0 to 1.
  Eigen::Matrix4d map_from_world() const;

 private:
  bool may_be_seen(const std::vector<Eigen::Vector3d>& corners, const Pose& T_world_rover,
                   const PinholeCamera& camera, const Pose& T_world_cam) const;
  void draw(const GpuScene& scene, const Pose& T_world_rover) const;

  bool casts_;
  Eigen::Vector3d towards_sun_;
  Eigen::Matrix3d R_sun_world_;
  int size_;
  GlTexture texture_;
  GlFramebuffer framebuffer_;
  GlProgram program_;
  std::optional<Pose> drawn_;  ///< where the map's rover stands
  Eigen::AlignedBox3d box_;    ///< of the map's rover, in the sun's axes
};

}  // namespace vinebench::sim
