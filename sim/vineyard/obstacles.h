// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "sim/scene/scene.h"
#include "sim/world/terrain.h"
#include "sim/world/world.h"

namespace vinebench::sim {

/// An upright block in an obstacle's frame.
struct Block {
  Eigen::Vector3d centre;  ///< m
  Eigen::Vector3d half;    ///< m
};

/// Frame of an obstacle: its foot on the ground, x where a person looks, z up.
Pose obstacle_pose(const WorldConfig::Obstacle& obstacle, const Terrain& terrain);

/// What the rover bumps into.
std::vector<Block> obstacle_blocks(const WorldConfig::Obstacle& obstacle);

/// People and harvest crates.
void add_obstacles(Scene& scene, const WorldConfig& world, const Terrain& terrain,
                   std::uint64_t seed);

}  // namespace vinebench::sim
