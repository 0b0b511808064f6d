// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "sim/plants/cultivar.h"
#include "sim/plants/grapevine_stage.h"
#include "sim/scene/mesh_builder.h"
#include "sim/scene/scene.h"

namespace vinebench::sim {

// Images of vines, generated from a seed; the same seed gives the same bytes.

/// Images that all plants of a cultivar, stage and seed share.
std::vector<Texture> plant_textures(const Cultivar& cultivar, const GrowthStage& stage,
                                    std::uint64_t seed);

/// Atlas of eight kinds of vine leaves, each with kLeafPrints prints of its veins and blotches,
/// transparent outside the blade: 0 to 3 mature, 4 and 5 old, 6 young, 7 with autumn colour; at
/// leaf fall 4 to 7 are yellow to brown.
Texture leaf_texture(std::uint64_t seed, const Cultivar& cultivar = {},
                     const GrowthStage& stage = {});
inline constexpr int kLeafVariants = 8;
inline constexpr int kLeafPrints = 4;
TextureCell leaf_cell(int variant, int print);

Texture bark_texture(std::uint64_t seed);

/// Shoots of this year in the left half, canes of last year in the right one.
Texture cane_texture(std::uint64_t seed, const GrowthStage& stage = {});

/// Packed berries around a bunch in the left half, four berries seen from outside in the right one;
/// flowers before fruit set.
Texture bunch_texture(std::uint64_t seed, const Cultivar& cultivar = {},
                      const GrowthStage& stage = {});
inline constexpr int kBerryVariants = 4;
TextureCell berry_cell(int variant);
TextureCell packed_berries_cell();

}  // namespace vinebench::sim
