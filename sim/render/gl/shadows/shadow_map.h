// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "sim/render/gl/scene/gpu_scene.h"

namespace vinebench::sim {

/// Depth as seen from the sun, drawn once: the sun and what stands in its light keep still.
class ShadowMap {
 public:
  /// `size` pixels a side, fitted around all that casts shadows; 0 makes a map without shadows.
  ShadowMap(const GpuScene& scene, int size);

  const GlTexture& texture() const { return texture_; }
  /// World to the map's texture coordinates and depth, all 0 to 1.
  const Eigen::Matrix4d& map_from_world() const { return map_from_world_; }
  double texel() const { return texel_; }  ///< m

 private:
  void draw(const GpuScene& scene, const Eigen::Matrix4d& light);

  GlTexture texture_;
  Eigen::Matrix4d map_from_world_ = Eigen::Matrix4d::Identity();
  double texel_ = 0;
};

}  // namespace vinebench::sim
