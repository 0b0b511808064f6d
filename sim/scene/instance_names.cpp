// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/scene/instance_names.h"

#include <array>

#include "core/util/error.h"

namespace vinebench {
namespace {

Thing thing_of(const Material& material) {
  if (material.terrain) return Thing::kGround;
  switch (material.label) {
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
      return Thing::kBox;
    case Label::kPerson:
      return Thing::kPerson;
    case Label::kRover:
      return Thing::kRover;
    default:
      return Thing::kCover;
  }
}

/// All of a model is of one kind, so that its first material tells it.
Thing thing_of(const Scene& scene, const Model& model) {
  for (const LevelOfDetail& level : model.levels) {
    for (const Primitive& primitive : level.primitives) {
      return thing_of(scene.materials.at(static_cast<std::size_t>(primitive.material)));
    }
  }
  return Thing::kNone;
}

}  // namespace

std::string name_of(Thing thing) {
  static const std::array<const char*, 9> kNames{"none", "ground", "vine",  "post", "tag",
                                                 "box",  "person", "rover", "cover"};
  return kNames.at(static_cast<std::size_t>(thing));
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
  return {thing_of(scene, model), static_cast<int>(index), instance.id, number & 255, model.name};
}

}  // namespace vinebench
