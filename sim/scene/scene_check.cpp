// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/scene/scene_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/util/error.h"

namespace vinebench::sim {
namespace {

constexpr int kLargestSide = 16384;  // px; supported by Mesa and current GPUs
constexpr float kFarthest = 1e6f;    // m

void check_index(std::int64_t index, std::size_t size, const char* what, const std::string& where) {
  if (index >= 0 && static_cast<std::size_t>(index) < size) return;
  fail("scene: {} names {} {}, expected 0 to {}", where, what, index,
       static_cast<std::int64_t>(size) - 1);
}

void check_numbers(bool sound, const std::string& where) {
  if (!sound) fail("scene: {}: expected finite numbers, found none or infinity", where);
}

/// Finite, and near enough that squares of distances stay finite too.
bool sound(const Eigen::Vector3f& position) {
  return position.allFinite() && position.cwiseAbs().maxCoeff() <= kFarthest;
}

void check(const Texture& texture) {
  const cv::Mat& rgba = texture.rgba;
  if (rgba.dims > 2 || rgba.empty() || rgba.type() != CV_8UC4) {
    fail("scene: texture '{}': expected an image of 4 channels of 8 bits", texture.name);
  }
  if (std::max(rgba.cols, rgba.rows) > kLargestSide) {
    fail("scene: texture '{}': expected at most {} pixels a side, found {} x {}", texture.name,
         kLargestSide, rgba.cols, rgba.rows);
  }
}

void check(const Material& material, const Scene& scene) {
  const std::string where = "material '" + material.name + "'";
  if (material.texture != -1) {
    check_index(material.texture, scene.textures.size(), "texture", where);
  }
  check_numbers(material.colour.allFinite() && std::isfinite(material.translucency), where);
}

void check(const Primitive& primitive, const Scene& scene, const std::string& where) {
  check_index(primitive.material, scene.materials.size(), "material", where);
  if (primitive.indices.size() % 3 != 0) {
    fail("scene: {} has {} indices, expected three for each triangle", where,
         primitive.indices.size());
  }
  for (const Vertex& v : primitive.vertices) {
    if (sound(v.position) && v.normal.allFinite() && v.uv.allFinite() &&
        std::isfinite(v.occlusion)) {
      continue;
    }
    fail("scene: {}: vertex {}: expected finite numbers and a place within {} m", where,
         &v - primitive.vertices.data(), kFarthest);
  }
  for (const std::uint32_t index : primitive.indices) {
    check_index(index, primitive.vertices.size(), "vertex", where);
  }
}

void check_models(const Scene& scene) {
  std::size_t vertices = 0;
  for (const Model& model : scene.models) {
    const std::string where = "model '" + model.name + "'";
    for (const LevelOfDetail& level : model.levels) {
      check_numbers(std::isfinite(level.until), where);
      for (const Primitive& primitive : level.primitives) {
        check(primitive, scene, where);
        vertices += primitive.vertices.size();
      }
    }
  }
  constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();
  if (vertices > kMost) fail("scene: {} vertices, expected at most {}", vertices, kMost);
}

void check(const Instance& instance, std::size_t index, const Scene& scene) {
  const std::string where = fmt::format("instance {}", index);
  check_index(instance.model, scene.models.size(), "model", where);
  const Pose& pose = instance.T_world_model;
  check_numbers(sound(pose.translation.cast<float>()) && pose.rotation.coeffs().allFinite(), where);
  if (!(instance.scale > 0) || !std::isfinite(instance.scale)) {
    fail("scene: {}: expected a scale above 0, found {}", where, instance.scale);
  }
}

}  // namespace

void check_scene(const Scene& scene) {
  for (const Texture& texture : scene.textures) check(texture);
  for (const Material& material : scene.materials) check(material, scene);
  check_models(scene);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) check(scene.instances[i], i, scene);
  for (std::size_t i = 0; i < scene.motions.size(); ++i) {
    const std::string where = fmt::format("motion {}", i);
    check_index(scene.motions[i].instance, scene.instances.size(), "instance", where);
    if (!scene.motions[i].T_world_model) fail("scene: {}: expected a pose for each instant", where);
  }
  if (scene.rover_model != -1) {
    check_index(scene.rover_model, scene.models.size(), "model", "the rover");
  }
  for (std::size_t i = 0; i < scene.wires.size(); ++i) {
    const Wire& wire = scene.wires[i];
    const std::string where = fmt::format("wire {}", i);
    check_index(wire.material, scene.materials.size(), "material", where);
    check_numbers(sound(wire.from) && sound(wire.to) && std::isfinite(wire.radius), where);
  }
  const Light& light = scene.light;
  check_numbers(light.towards_sun.allFinite() && light.sun.allFinite() && light.sky.allFinite() &&
                    light.bounce.allFinite() && std::isfinite(light.overcast) &&
                    std::isfinite(light.haze) && std::isfinite(light.glare),
                "light");
  check_numbers(std::isfinite(scene.wind.speed) && scene.wind.towards.allFinite(), "wind");
}

}  // namespace vinebench::sim
