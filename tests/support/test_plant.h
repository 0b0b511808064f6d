// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "sim/plants/grapevine.h"
#include "sim/plants/plant_textures.h"

namespace vinebench::test {

inline constexpr std::array<sim::Training, 4> kTrainings{
    sim::Training::kBilateralCordon, sim::Training::kUnilateralCordon, sim::Training::kSingleGuyot,
    sim::Training::kDoubleGuyot};
inline constexpr std::array<int, 8> kCodes{0, 9, 65, 75, 79, 83, 89, 95};
inline constexpr std::array<std::uint64_t, 4> kSeeds{1, 2, 77, 123456789};

inline sim::PlantBrief brief(int bbch = 89,
                             sim::Training training = sim::Training::kBilateralCordon) {
  sim::PlantBrief brief;
  brief.vines.bbch = bbch;
  brief.vines.training = training;
  brief.stage = sim::growth_stage(bbch);
  return brief;
}

/// Painted once: tests that do not depend on them share them.
inline const std::vector<sim::Texture>& textures() {
  static const std::vector<sim::Texture> kTextures =
      sim::plant_textures({}, sim::growth_stage(89), 1);
  return kTextures;
}

inline sim::Asset plant(const sim::PlantBrief& brief, std::uint64_t seed, int index = 0) {
  return sim::mesh_grapevines({sim::grow_grapevine(brief, seed, index)}, textures()).at(0);
}

inline Label label_of(const sim::Asset& asset, const sim::Primitive& primitive) {
  return asset.materials.at(static_cast<std::size_t>(primitive.material)).label;
}

template <class Visit>
void for_each_primitive(const sim::Asset& asset, const Visit& visit) {
  for (const sim::LevelOfDetail& level : asset.model.levels) {
    for (const sim::Primitive& primitive : level.primitives)
      visit(primitive, label_of(asset, primitive));
  }
}

inline bool has(const sim::Asset& asset, Label label) {
  bool found = false;
  for_each_primitive(asset, [&](const sim::Primitive&, Label other) { found |= other == label; });
  return found;
}

}  // namespace vinebench::test
