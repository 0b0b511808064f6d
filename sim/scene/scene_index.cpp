// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/scene/scene_index.h"

#include "core/util/error.h"

namespace vinebench {
namespace {

using Points = std::vector<Eigen::Vector3f>;

/// Every n-th, so that at most kMostPoints are left.
Points thinned(const Points& all) {
  const std::size_t step = all.size() / SceneIndex::kMostPoints + 1;
  Points kept;
  for (std::size_t i = 0; i < all.size(); i += step) kept.push_back(all[i]);
  return kept;
}

bool has_outline(Thing thing) {
  return thing != Thing::kNone && thing != Thing::kGround && thing != Thing::kCover;
}

/// Vertices of the finest level, by part; the whole is part 0.
std::map<int, Points> points_by_part(const Model& model) {
  std::map<int, Points> parts;
  if (model.levels.empty()) return parts;
  for (const Primitive& primitive : model.levels.front().primitives) {
    for (const Vertex& vertex : primitive.vertices) {
      parts[0].push_back(vertex.position);
      if (vertex.part > 0) parts[vertex.part].push_back(vertex.position);
    }
  }
  return parts;
}

}  // namespace

SceneIndex::SceneIndex(const Scene& scene) {
  const auto count = static_cast<std::int32_t>(scene.instances.size());
  for (std::int32_t i = 0; i < count; ++i) {
    const Instance& instance = scene.instances[static_cast<std::size_t>(i)];
    places_.push_back({instance_name(scene, 256 * (i + 1)), instance.model, instance.T_world_model,
                       static_cast<double>(instance.scale)});
    if (!has_outline(places_.back().name.thing) || points_.contains({instance.model, 0})) continue;
    const Model& model = scene.models.at(static_cast<std::size_t>(instance.model));
    for (const auto& [part, points] : points_by_part(model)) {
      points_[{instance.model, part}] = thinned(points);
    }
  }
  has_rover_ = scene.rover_model >= 0;
  if (has_rover_) rover_ = instance_name(scene, 256 * (count + 1));
}

const SceneIndex::Place* SceneIndex::place_of(std::int32_t number) const {
  const auto index = static_cast<std::size_t>((number >> 8) - 1);
  return number < 256 || index >= places_.size() ? nullptr : &places_[index];
}

const InstanceName& SceneIndex::whole(std::int32_t number) const {
  static const InstanceName kNobody;
  if (number == 0) return kNobody;
  if (const Place* place = place_of(number)) return place->name;
  if (has_rover_ && (number >> 8) - 1 == static_cast<std::int64_t>(places_.size())) return rover_;
  fail("instance number {}: the scene has {} instances", number, places_.size());
}

InstanceName SceneIndex::name(std::int32_t number) const {
  InstanceName name = whole(number);
  name.part = number & 255;
  return name;
}

Thing SceneIndex::thing(std::int32_t number) const {
  return whole(number).thing;
}

std::vector<Eigen::Vector3d> SceneIndex::points(std::int32_t number) const {
  const Place* place = place_of(number);
  if (place == nullptr) return {};
  const auto found = points_.find({place->model, number & 255});
  if (found == points_.end()) return {};
  std::vector<Eigen::Vector3d> world;
  for (const Eigen::Vector3f& p : found->second) {
    world.push_back(place->T_world_model * (place->scale * p.cast<double>()));
  }
  return world;
}

std::vector<std::int32_t> SceneIndex::bunches() const {
  std::vector<std::int32_t> numbers;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (places_[i].name.thing != Thing::kVine) continue;
    for (auto part = points_.lower_bound({places_[i].model, 1});
         part != points_.end() && part->first.first == places_[i].model; ++part) {
      numbers.push_back(static_cast<std::int32_t>(256 * (i + 1)) + part->first.second);
    }
  }
  return numbers;
}

}  // namespace vinebench
