// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/geometry/pose.h"
#include "core/truth/labels.h"

namespace vinebench {

/// Names and positions of the numbers in RenderedImage::instances, without meshes.
class SceneIndex {
 public:
  /// An instance of a scene and its pose.
  struct Place {
    InstanceName name;  ///< of the whole
    int model = -1;
    Pose T_world_model;
    double scale = 1;
  };
  /// By model and part, in the model's frame, m; part 0 is the whole.
  using Points = std::map<std::pair<int, int>, std::vector<Eigen::Vector3f>>;

  SceneIndex() = default;
  /// Of all instances of a scene in its order, the points of their models, at most kMostPoints a
  /// part, and the rover, if there is one.
  SceneIndex(std::vector<Place> places, Points points, std::optional<InstanceName> rover)
      : places_(std::move(places)), rover_(std::move(rover)), points_(std::move(points)) {}

  /// Throws Error for a number that the scene does not have.
  InstanceName name(std::int32_t number) const;

  /// The kind only.
  Thing thing(std::int32_t number) const;

  /// Points spread over the surface of a plant, a bunch of it (by the part) or another object, m in
  /// the world frame, in still air: at most kMostPoints. None for ground, cover and rover.
  std::vector<Eigen::Vector3d> points(std::int32_t number) const;

  /// Numbers of all bunches of the scene, in ascending order.
  std::vector<std::int32_t> bunches() const;

  static constexpr std::size_t kMostPoints = 128;

 private:
  const Place* place_of(std::int32_t number) const;
  const InstanceName& whole(std::int32_t number) const;

  std::vector<Place> places_;  ///< of Scene::instances
  std::optional<InstanceName> rover_;
  Points points_;
};

}  // namespace vinebench
