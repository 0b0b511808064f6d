// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "sim/scene/instance_names.h"
#include "sim/scene/scene.h"

namespace vinebench {

/// What the numbers of RenderedImage::instances mean, and where these things are, without their
/// meshes.
class SceneIndex {
 public:
  SceneIndex() = default;
  explicit SceneIndex(const Scene& scene);

  /// As instance_name(). Throws Error for a number that the scene does not have.
  InstanceName name(std::int32_t number) const;

  /// The name's kind alone.
  Thing thing(std::int32_t number) const;

  /// Points spread over the surface of a plant, a bunch of it (by the part) or another thing, m in
  /// the world frame, in still air: at most kMostPoints. None of ground, cover and rover.
  std::vector<Eigen::Vector3d> points(std::int32_t number) const;

  /// Numbers of all bunches of the scene, in ascending order.
  std::vector<std::int32_t> bunches() const;

  static constexpr std::size_t kMostPoints = 128;

 private:
  struct Place {
    InstanceName name;  ///< of the whole
    int model = -1;
    Pose T_world_model;
    double scale = 1;
  };
  const Place* place_of(std::int32_t number) const;
  const InstanceName& whole(std::int32_t number) const;

  std::vector<Place> places_;  ///< of Scene::instances
  InstanceName rover_;
  bool has_rover_ = false;
  /// By model and part, in the model's frame.
  std::map<std::pair<int, int>, std::vector<Eigen::Vector3f>> points_;
};

}  // namespace vinebench
