// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/scene/block_mesh.h"
#include "sim/textures/textures.h"
#include "sim/vineyard/occluders/occluder_shape.h"

namespace vinebench::sim {
namespace {

using Eigen::Vector3f;

/// Rectangles of carton_texture.
const TextureCell kPlainCarton{{0.01f, 0.01f}, {0.99f, 0.49f}};
const TextureCell kTapedCarton{{0.01f, 0.51f}, {0.99f, 0.99f}};

Primitive box_mesh(const Vector3f& half) {
  const Vector3f x = half.x() * Vector3f::UnitX();
  const Vector3f y = half.y() * Vector3f::UnitY();
  const Vector3f z = half.z() * Vector3f::UnitZ();
  constexpr float kFootLight = 0.55f;
  Primitive primitive;
  MeshBuilder builder(primitive);
  add_face(builder, x, y, z, kTapedCarton, kFootLight);
  add_face(builder, -x, -y, z, kTapedCarton, kFootLight);
  add_face(builder, -y, x, z, kPlainCarton, kFootLight);
  add_face(builder, y, -x, z, kPlainCarton, kFootLight);
  add_face(builder, z, -y, x, kTapedCarton);
  add_face(builder, -z, y, x, kPlainCarton, kFootLight);
  return primitive;
}

}  // namespace

OccluderModel box_model(const Occluder& occluder, std::uint64_t seed) {
  const Eigen::Vector3d half = size_of(occluder) / 2;
  OccluderModel model{.origin = half.z()};
  model.asset.add(occluder.printed ? print_texture(static_cast<std::uint64_t>(occluder.print_seed))
                                   : carton_texture(seed));
  model.asset.add(make_material(name_of(occluder), label_of(class_of(occluder)), 0));
  model.asset.materials[0].colour = linear_colour(colour_of(occluder));
  model.asset.model.levels.push_back({1e9, {box_mesh(half.cast<float>())}});
  return model;
}

}  // namespace vinebench::sim
