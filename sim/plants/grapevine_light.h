// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "sim/scene/mesh_builder.h"

namespace vinebench::sim {

/// Ambient light between the leaves (Beer-Lambert through a grid of leaf density).
class CanopyLight {
 public:
  explicit CanopyLight(const std::vector<BladePlacement>& leaves);

  /// Share of the light of an unobstructed sky, 0 to 1.
  float at(const Eigen::Vector3f& point) const;

 private:
  float* find(const Eigen::Vector3f& point) {
    return const_cast<float*>(static_cast<const CanopyLight*>(this)->find(point));
  }
  const float* find(const Eigen::Vector3f& point) const;
  /// Leaf area per area across the ray, up to 0.4 m away.
  float leaf_area_along(const Eigen::Vector3f& from, const Eigen::Vector3f& direction) const;

  Eigen::AlignedBox3f box_;
  Eigen::Vector3i size_ = Eigen::Vector3i::Zero();
  std::vector<float> density_;
};

}  // namespace vinebench::sim
