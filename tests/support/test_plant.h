// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "sim/plants/grapevine.h"
#include "sim/textures/textures.h"

namespace vinebench::test {

inline constexpr std::array<Training, 4> kTrainings{Training::kBilateralCordon,
                                                    Training::kUnilateralCordon,
                                                    Training::kSingleGuyot, Training::kDoubleGuyot};
inline constexpr std::array<int, 7> kCodes{0, 9, 65, 75, 83, 89, 95};
inline constexpr std::array<std::uint64_t, 4> kSeeds{1, 2, 77, 123456789};

inline PlantBrief brief(int bbch = 89, Training training = Training::kBilateralCordon) {
  PlantBrief brief;
  brief.vines.bbch = bbch;
  brief.vines.training = training;
  brief.stage = growth_stage(bbch);
  return brief;
}

/// Painted once: every test that does not look at them uses the same ones.
inline const std::vector<Texture>& textures() {
  static const std::vector<Texture> kTextures = plant_textures({}, growth_stage(89), 1);
  return kTextures;
}

inline Asset plant(const PlantBrief& brief, std::uint64_t seed, int index = 0) {
  return mesh_grapevines({grow_grapevine(brief, seed, index)}, textures()).at(0);
}

inline Label label_of(const Asset& asset, const Primitive& primitive) {
  return asset.materials.at(static_cast<std::size_t>(primitive.material)).label;
}

template <class Visit>
void for_each_primitive(const Asset& asset, const Visit& visit) {
  for (const LevelOfDetail& level : asset.model.levels) {
    for (const Primitive& primitive : level.primitives)
      visit(primitive, label_of(asset, primitive));
  }
}

inline bool has(const Asset& asset, Label label) {
  bool found = false;
  for_each_primitive(asset, [&](const Primitive&, Label other) { found |= other == label; });
  return found;
}

}  // namespace vinebench::test
