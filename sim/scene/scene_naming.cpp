// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/scene/scene_naming.h"

#include "core/util/error.h"

namespace vinebench::sim {
namespace {

/// Where a model does not say, all of its parts are of one kind, so its first material determines
/// it.
Thing thing_of_model(const Scene& scene, const Model& model) {
  if (model.thing != Thing::kNone) return model.thing;
  for (const LevelOfDetail& level : model.levels) {
    for (const Primitive& primitive : level.primitives) {
      const Material& material = scene.materials.at(static_cast<std::size_t>(primitive.material));
      return material.terrain ? Thing::kGround : thing_of(material.label);
    }
  }
  return Thing::kNone;
}

using Points = std::vector<Eigen::Vector3f>;

/// Every N-th, so that at most kMostPoints remain.
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

Thing thing_of(Label label) {
  switch (label) {
    case Label::kTrunk:
    case Label::kCane:
    case Label::kLeaf:
    case Label::kBunch:
      return Thing::kVine;
    case Label::kPost:
      return Thing::kPost;
    case Label::kTag:
      return Thing::kTag;
    case Label::kBox:
    case Label::kCrate:
      return Thing::kBox;
    case Label::kPerson:
      return Thing::kPerson;
    case Label::kRover:
      return Thing::kRover;
    case Label::kTarpaulin:
    case Label::kLooseLeaf:
    case Label::kOccluder:
      return Thing::kOccluder;
    default:
      return Thing::kCover;
  }
}

InstanceName instance_name(const Scene& scene, std::int32_t number) {
  if (number == 0) return {};
  const std::int64_t index = (static_cast<std::int64_t>(number) >> 8) - 1;
  const auto count = static_cast<std::int64_t>(scene.instances.size());
  if (index == count && scene.rover_model >= 0) {
    const Model& rover = scene.models.at(static_cast<std::size_t>(scene.rover_model));
    return {Thing::kRover, -1, -1, number & 255, rover.name};
  }
  if (index < 0 || index >= count) {
    fail("instance number {}: the scene has {} instances, expected 0 or 256 to {}", number, count,
         256 * count + 255);
  }
  const Instance& instance = scene.instances[static_cast<std::size_t>(index)];
  const Model& model = scene.models.at(static_cast<std::size_t>(instance.model));
  return {thing_of_model(scene, model), static_cast<int>(index), instance.id, number & 255,
          model.name};
}

SceneIndex index_of(const Scene& scene) {
  std::vector<SceneIndex::Place> places;
  SceneIndex::Points points;
  const auto count = static_cast<std::int32_t>(scene.instances.size());
  for (std::int32_t i = 0; i < count; ++i) {
    const Instance& instance = scene.instances[static_cast<std::size_t>(i)];
    places.push_back({instance_name(scene, 256 * (i + 1)), instance.model, instance.T_world_model,
                      static_cast<double>(instance.scale)});
    if (!has_outline(places.back().name.thing) || points.contains({instance.model, 0})) continue;
    const Model& model = scene.models.at(static_cast<std::size_t>(instance.model));
    for (const auto& [part, all] : points_by_part(model)) {
      points[{instance.model, part}] = thinned(all);
    }
  }
  std::optional<InstanceName> rover;
  if (scene.rover_model >= 0) rover = instance_name(scene, 256 * (count + 1));
  return {std::move(places), std::move(points), std::move(rover)};
}

}  // namespace vinebench::sim
