// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "sim/render/gl/scene/gpu_scene.h"
#include "sim/render/gl/scene/mesh_programs.h"
#include "sim/render/gl/scene/view_block.h"
#include "sim/render/gl/shadows/shadow_map.h"

namespace vinebench::sim {

/// The light that arrives at the ground, sun and sky, baked once and seen from above: one cheap
/// look-up a pixel in place of a comparison with the shadow map. Beyond it the ground lies open.
class LightMap {
 public:
  /// `largest`: pixels a side at most.
  LightMap(const GpuScene& scene, const ShadowMap& shadows, MeshPrograms& programs,
           const ViewBuffer& view, int largest);

  const GlTexture& texture() const { return texture_; }
  /// Whether all of the instance lies beyond the map.
  bool is_open(const GpuInstance& instance) const;
  /// The light of open ground, as the texture has it: 0 to 1.
  const Eigen::Vector3f& open_light() const { return open_light_; }
  /// Scale and offset from the world's x and y (m) to the texture's coordinates.
  const Eigen::Vector4f& map_from_world() const { return map_from_world_; }
  /// Light that the texture's 1 stands for, encoded.
  static constexpr double kBrightest = 1.3;

 private:
  cv::Mat bake(const GpuScene& scene, const ShadowMap& shadows, MeshPrograms& programs,
               const ViewBuffer& view, const cv::Size& size) const;

  GlTexture texture_;
  Eigen::AlignedBox2d box_;  ///< m, world
  Eigen::Vector3f open_light_ = Eigen::Vector3f::Ones();
  Eigen::Vector4f map_from_world_ = Eigen::Vector4f::Zero();
};

}  // namespace vinebench::sim
