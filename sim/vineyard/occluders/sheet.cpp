// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/scene/block_mesh.h"
#include "sim/textures/textures.h"
#include "sim/vineyard/occluders/occluder_shape.h"

namespace vinebench::sim {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float kFold = 0.5f;   // m, from fold to fold
constexpr float kStep = 0.06f;  // m, between vertices across
constexpr int kRows = 6;        // of vertices, less one

/// A hanging sheet with folds that deepen to its foot; seen from both sides.
Primitive sheet_mesh(const Vector3f& size) {
  Primitive primitive;
  MeshBuilder builder(primitive);
  const int columns = std::max(2, static_cast<int>(std::ceil(size.y() / kStep)));
  std::vector<std::uint32_t> before;
  for (int c = 0; c <= columns; ++c) {
    const float across = static_cast<float>(c) / static_cast<float>(columns);
    const float y = (across - 0.5f) * size.y();
    const float turn = 2 * std::numbers::pi_v<float> * y / kFold;
    std::vector<std::uint32_t> column;
    for (int r = 0; r <= kRows; ++r) {
      const float down = static_cast<float>(r) / kRows;
      const float depth = size.x() / 2 * (0.3f + 0.7f * down);
      const float slope = depth * 2 * std::numbers::pi_v<float> / kFold * std::cos(turn);
      column.push_back(builder.vertex({depth * std::sin(turn), y, (0.5f - down) * size.z()},
                                      Vector3f(1, -slope, 0).normalized(), Vector2f(across, down),
                                      0.85f + 0.15f * std::sin(turn)));
    }
    for (int r = 0; r < kRows && c > 0; ++r) {
      const auto at = static_cast<std::size_t>(r);
      builder.quad(before[at + 1], column[at + 1], column[at], before[at]);
    }
    before = std::move(column);
  }
  return primitive;
}

}  // namespace

OccluderModel sheet_model(const Occluder& occluder, std::uint64_t seed) {
  const Eigen::Vector3d size = size_of(occluder);
  OccluderModel model{.origin = size.z() / 2};
  model.asset.add(cloth_texture(seed));
  model.asset.add(make_material(name_of(occluder), label_of(class_of(occluder)), 0));
  model.asset.materials[0].colour = linear_colour(colour_of(occluder));
  model.asset.materials[0].double_sided = true;
  model.asset.model.levels.push_back({1e9, {sheet_mesh(size.cast<float>())}});
  return model;
}

}  // namespace vinebench::sim
