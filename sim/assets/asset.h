// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "sim/scene/scene.h"

namespace vinebench::sim {

/// A model with the textures and materials that it brings along; its indices count from its own.
struct Asset {
  std::vector<Texture> textures;
  std::vector<Material> materials;
  Model model;

  int add(Texture texture);
  int add(Material material);
  /// Sets the model's bounds from its finest level that has vertices.
  void update_bounds();
};

/// Adds the asset to the scene and returns the model's index there. Textures and materials that
/// the scene already has, equal to the last bit, are shared.
int add_asset(Scene& scene, Asset asset);

Material make_material(std::string name, Label label, int texture);

int triangle_count(const LevelOfDetail& level);

}  // namespace vinebench::sim
