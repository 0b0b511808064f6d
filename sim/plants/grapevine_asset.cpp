// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "sim/plants/grapevine.h"
#include "sim/plants/grapevine_mesh.h"

namespace vinebench::sim {
namespace {

constexpr std::array<MeshDetail, 3> kNear{{{0.65, 32000, 9, 4, 1, true, 4, Berries::kRound},
                                           {1.15, 5600, 7, 3, 1, false, 2, Berries::kCaps},
                                           {3.3, 2500, 5, 3, 2, false, 0, Berries::kSolid}}};

std::vector<Material> plant_materials() {
  std::vector<Material> materials(kPlantMaterials);
  materials[kTrunkMaterial] = make_material("bark", Label::kTrunk, kBarkTexture);
  materials[kCaneMaterial] = make_material("cane", Label::kCane, kCaneTexture);
  materials[kBunchMaterial] = make_material("bunch", Label::kBunch, kBunchTexture);
  materials[kBunchMaterial].translucency = 0.25f;
  materials[kBunchMaterial].vertex_colours = true;
  Material& leaf = materials[kLeafMaterial] = make_material("leaf", Label::kLeaf, kLeafTexture);
  leaf.double_sided = true;
  leaf.translucency = 0.35f;
  leaf.vertex_colours = true;
  Material& foliage = materials[kFoliageMaterial] = leaf;
  foliage.name = "foliage";
  foliage.texture = kFoliageTexture;
  foliage.cutout = true;
  foliage.vertex_colours = false;
  Material& card = materials[kLeafCardMaterial] = leaf;
  card.name = "leaf card";
  card.cutout = true;
  Material& shelter = materials[kShelterMaterial] = make_material("grow tube", Label::kTrunk, -1);
  shelter.colour = {0.42f, 0.52f, 0.30f};
  shelter.double_sided = true;
  shelter.translucency = 0.4f;
  return materials;
}

}  // namespace

std::vector<Asset> mesh_grapevines(const std::vector<Grapevine>& plants,
                                   const std::vector<Texture>& textures) {
  const std::vector<Material> materials = plant_materials();
  const FarPlants far(plants, textures, materials);
  std::vector<Asset> assets;
  for (std::size_t i = 0; i < plants.size(); ++i) {
    Asset& asset = assets.emplace_back();
    asset.textures = textures;
    asset.textures.push_back(far.texture());
    asset.materials = materials;
    asset.model.name = "grapevine";
    const CanopyLight light(plants[i].leaves);
    for (const MeshDetail& detail : kNear) {
      asset.model.levels.push_back(mesh_near(plants[i], detail, light));
    }
    for (LevelOfDetail& level : far.levels(i)) asset.model.levels.push_back(std::move(level));
    asset.update_bounds();
  }
  return assets;
}

}  // namespace vinebench::sim
