// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/scene/scene.h"
#include "sim/world/world_layout.h"

namespace vinebench::sim {

/// The soil and its mown strips: tiles of the terrain's own grid, coarser with the distance, and an
/// apron around them up to the ground's edge.
void add_ground(Scene& scene, const WorldConfig& world, const WorldLayout& layout,
                std::uint64_t seed);

/// Ground cover: weeds under the rows, mown grass or fallen leaves and pebbles in the aisles, grass
/// around the vineyard.
void add_ground_cover(Scene& scene, const WorldConfig& world, const WorldLayout& layout,
                      std::uint64_t seed);

/// A hedge at the edge of the ground and hills behind it.
void add_backdrop(Scene& scene, const WorldConfig& world, const Terrain& terrain,
                  std::uint64_t seed);

}  // namespace vinebench::sim
