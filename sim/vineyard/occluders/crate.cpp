// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/scene/block_mesh.h"
#include "sim/textures/textures.h"
#include "sim/vineyard/occluders/occluder_shape.h"

namespace vinebench::sim {
namespace {

using Eigen::Vector3f;

constexpr double kCrateFar = 8;  // m; coarser beyond

/// Slats between corner posts round an open top, and a floor.
Primitive crate_mesh(const Vector3f& half, bool fine) {
  Primitive primitive;
  MeshBuilder builder(primitive);
  const auto block = [&](const Vector3f& centre, const Vector3f& size) {
    add_block(builder, centre, size, 0.7f);
  };
  constexpr float kWall = 0.008f;
  const int slats = fine ? 4 : 1;
  const float pitch = 2 * half.z() / slats;
  for (int i = 0; i < slats; ++i) {
    const float z = (i + 0.5f) * pitch, tall = fine ? 0.36f * pitch : 0.5f * pitch;
    for (const float side : {-1.0f, 1.0f}) {
      block({side * half.x(), 0, z}, {kWall, half.y(), tall});
      block({0, side * half.y(), z}, {half.x(), kWall, tall});
    }
  }
  for (const float x : {-1.0f, 1.0f}) {
    for (const float y : {-1.0f, 1.0f}) {
      block({x * (half.x() - kWall), y * (half.y() - kWall), half.z()},
            {0.025f, 0.025f, half.z() + 0.004f});
    }
  }
  block({0, 0, 0.02f}, {half.x(), half.y(), 0.01f});
  return primitive;
}

}  // namespace

OccluderModel crate_model(const Occluder& occluder, std::uint64_t seed) {
  OccluderModel model;
  model.asset.add(cloth_texture(seed));
  model.asset.add(make_material("crate", label_of(class_of(occluder)), 0));
  model.asset.materials[0].colour = linear_colour(colour_of(occluder));
  const Vector3f half = (size_of(occluder) / 2).cast<float>();
  model.asset.model.levels = {{kCrateFar, {crate_mesh(half, true)}},
                              {1e9, {crate_mesh(half, false)}}};
  return model;
}

}  // namespace vinebench::sim
