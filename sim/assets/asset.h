// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "sim/scene/scene.h"

namespace vinebench::sim {

/// A model with its own textures and materials; its indices refer to them.
struct Asset {
  std::vector<Texture> textures;
  std::vector<Material> materials;
  Model model;

  int add(Texture texture);
  int add(Material material);
  /// Sets the model's bounds from the finest level with vertices.
  void update_bounds();
};

/// Adds the asset to the scene and returns the model's index there. Bitwise equal textures and
/// materials of the scene are shared.
int add_asset(Scene& scene, Asset asset);

Material make_material(std::string name, Label label, int texture);

int triangle_count(const LevelOfDetail& level);

}  // namespace vinebench::sim
