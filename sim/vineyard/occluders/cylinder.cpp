// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "sim/scene/block_mesh.h"
#include "sim/textures/textures.h"
#include "sim/vineyard/occluders/occluder_shape.h"

namespace vinebench::sim {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr int kSides = 32;

/// A wall about the vertical and a lid at either end; `half` are its half axes and half height.
Primitive cylinder_mesh(const Vector3f& half) {
  constexpr float kFootLight = 0.55f;
  Primitive primitive;
  MeshBuilder builder(primitive);
  const auto rim = [&](int side, float z) {
    const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(side) / kSides;
    return Vector3f(half.x() * std::cos(angle), half.y() * std::sin(angle), z);
  };
  for (int i = 0; i < kSides; ++i) {
    const auto corner = [&](int side, float z, float light) {
      const Vector3f p = rim(side, z);
      const Vector3f normal(p.x() / (half.x() * half.x()), p.y() / (half.y() * half.y()), 0);
      const Vector2f uv(static_cast<float>(side) / kSides, z < 0 ? 1.0f : 0.0f);
      return builder.vertex(p, normal.normalized(), uv, light);
    };
    builder.quad(corner(i, -half.z(), kFootLight), corner(i + 1, -half.z(), kFootLight),
                 corner(i + 1, half.z(), 1), corner(i, half.z(), 1));
  }
  for (const float side : {-1.0f, 1.0f}) {
    const Vector3f normal(0, 0, side);
    const auto point = [&](const Vector3f& p) {
      return builder.vertex(p, normal, Vector2f(0.5f, 0.5f), side < 0 ? kFootLight : 1.0f);
    };
    const auto middle = point(side * half.z() * Vector3f::UnitZ());
    for (int i = 0; i < kSides; ++i) {
      const auto a = point(rim(i, side * half.z())), b = point(rim(i + 1, side * half.z()));
      builder.triangle(middle, side > 0 ? a : b, side > 0 ? b : a);
    }
  }
  return primitive;
}

}  // namespace

OccluderModel cylinder_model(const Occluder& occluder, std::uint64_t seed) {
  const Eigen::Vector3d half = size_of(occluder) / 2;
  OccluderModel model{.origin = half.z()};
  model.asset.add(cloth_texture(seed));
  model.asset.add(make_material(name_of(occluder), label_of(class_of(occluder)), 0));
  model.asset.materials[0].colour = linear_colour(colour_of(occluder));
  model.asset.model.levels.push_back({1e9, {cylinder_mesh(half.cast<float>())}});
  return model;
}

}  // namespace vinebench::sim
