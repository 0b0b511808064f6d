// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/scene/scene.h"
#include "sim/world/world_layout.h"

namespace vinebench::sim {

/// Everything that a world's list of occluders asks for, in its order. An instance's id is the
/// occluder's place in the list of its file.
void add_occluders(Scene& scene, const WorldConfig& world, const WorldLayout& layout,
                   std::uint64_t seed);

}  // namespace vinebench::sim
