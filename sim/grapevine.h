// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "sim/asset.h"
#include "sim/plant_geometry.h"
#include "sim/world.h"

namespace vinebench {

/// A bunch of berries that hangs from its shoot.
struct Bunch {
  Eigen::Vector3f top;           ///< m
  float length = 0.12f;          ///< m, top to the lowest berry's underside
  float radius = 0.035f;         ///< m, at its widest
  std::uint64_t berry_seed = 0;  ///< for where each berry sits
};

/// One grown vine on a wire trellis: shoots stand upright between the wires, the fruit hangs below
/// them. Model frame: origin at the foot, x along the row, z up; m.
struct Grapevine {
  std::vector<Tube> wood;              ///< trunk, then cordon arms
  std::vector<Tube> canes;             ///< this year's shoots
  std::vector<Tube> stalks;            ///< of leaves and bunches
  std::vector<BladePlacement> leaves;  ///< no part further than half_depth from the row's plane
  std::vector<Bunch> bunches;          ///< none below Vines::lowest_bunch
  float half_depth = 0.15f;            ///< m
};

/// Plants are enlarged by up to this when they are set into a row; they are grown that much
/// narrower.
inline constexpr double kLargestPlantScale = 1.03;

/// Plant number `index` of a seed. Uses all of `vines` but its templates and meshes.
Grapevine grow_grapevine(const WorldConfig::Vines& vines, std::uint64_t seed, int index);

/// Pictures that all plants of a seed share.
std::vector<Texture> plant_textures(std::uint64_t seed);

/// The plant's four levels of detail as triangles. Occlusion is baked from the leaves' density.
Asset mesh_grapevine(const Grapevine& plant, std::vector<Texture> textures);

}  // namespace vinebench
