// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/scene/scene.h"
#include "sim/world/world_layout.h"

namespace vinebench::sim {

/// The brace of an end post: a strut inside the row or a wire to an anchor outside it.
struct Brace {
  Eigen::Vector3d foot;  ///< m, world
  Eigen::Vector3d head;  ///< m, world; on the post
  double radius = 0;     ///< m
};

/// The braces of all end posts, in the posts' order; empty if the world has none.
std::vector<Brace> trellis_braces(const WorldConfig::Trellis& trellis, const WorldLayout& layout);

/// Posts, braces, wires and drip lines of every row.
void add_trellis(Scene& scene, const WorldConfig::Trellis& trellis, const WorldLayout& layout,
                 std::uint64_t seed);

}  // namespace vinebench::sim
