// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/scene.h"
#include "sim/world.h"

namespace vinebench {

/// Of all row ends, m.
Eigen::AlignedBox2d rows_box(const WorldConfig& world);

/// The soil, plane at z = 0.
void add_ground(Scene& scene, const WorldConfig& world, std::uint64_t seed);

/// What lies and grows on it: weeds under the rows, fallen leaves and pebbles in the aisles, grass
/// round the vineyard.
void add_ground_cover(Scene& scene, const WorldConfig& world, std::uint64_t seed);

/// A hedge at the edge of the ground and hills behind it.
void add_backdrop(Scene& scene, const WorldConfig& world, std::uint64_t seed);

}  // namespace vinebench
