// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "sim/assets/asset.h"
#include "sim/plants/grapevine_shape.h"

namespace vinebench::sim {

/// Plant number `index` of a seed.
Grapevine grow_grapevine(const PlantBrief& brief, std::uint64_t seed, int index);

/// Area of one side of all its leaves, m^2.
double leaf_area(const Grapevine& plant);

/// The plants' levels of detail as triangles, one asset a plant. Near ones are meshes; far ones are
/// painted from the plant itself into one more image, which all share. Occlusion is baked from
/// the leaves' density. Vertices of a plant's i-th bunch carry the part i + 1 (255 at most).
std::vector<Asset> mesh_grapevines(const std::vector<Grapevine>& plants,
                                   const std::vector<Texture>& textures);

}  // namespace vinebench::sim
