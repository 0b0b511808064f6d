// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <set>

#include "sim/plants/grapevine_mesh.h"
#include "tests/support/test_plant.h"

namespace vinebench::sim {
namespace {

class GrapevineAssetTest : public testing::Test {
 protected:
  static const std::vector<Asset>& assets() {
    static const std::vector<Grapevine> kPlants{grow_grapevine(test::brief(), 1, 0),
                                                grow_grapevine(test::brief(), 1, 1)};
    static const std::vector<Asset> kAssets = mesh_grapevines(kPlants, test::textures());
    return kAssets;
  }
};

TEST_F(GrapevineAssetTest, EachPlantIsAnAssetOfSharedImages) {
  ASSERT_EQ(assets().size(), 2u);
  for (const Asset& asset : assets()) {
    EXPECT_EQ(asset.model.name, "grapevine");
    ASSERT_EQ(asset.textures.size(), test::textures().size() + 1);
    // The painted views are the last image, and one for all.
    EXPECT_EQ(asset.textures.back().name, "foliage");
    EXPECT_EQ(asset.textures.back().rgba.data, assets()[0].textures.back().rgba.data);
    EXPECT_EQ(asset.materials.at(kFoliageMaterial).texture,
              static_cast<int>(asset.textures.size()) - 1);
  }
  EXPECT_NE(assets()[0].model.levels[0].primitives[0].vertices[0].position,
            assets()[1].model.levels[0].primitives[0].vertices[0].position);
}

TEST_F(GrapevineAssetTest, MaterialsHaveTheLabelsOfTheirParts) {
  const std::vector<Material>& materials = assets()[0].materials;
  ASSERT_EQ(materials.size(), std::size_t{kPlantMaterials});
  EXPECT_EQ(materials[kTrunkMaterial].label, Label::kTrunk);
  EXPECT_EQ(materials[kCaneMaterial].label, Label::kCane);
  EXPECT_EQ(materials[kBunchMaterial].label, Label::kBunch);
  EXPECT_EQ(materials[kLeafMaterial].label, Label::kLeaf);
  EXPECT_EQ(materials[kFoliageMaterial].label, Label::kLeaf);
  // Blades are seen from both sides and let light through; cards have the leaves' outline as alpha.
  EXPECT_TRUE(materials[kLeafMaterial].double_sided);
  EXPECT_GT(materials[kLeafMaterial].translucency, 0);
  EXPECT_FALSE(materials[kLeafMaterial].cutout);
  EXPECT_TRUE(materials[kFoliageMaterial].cutout);
  EXPECT_TRUE(materials[kLeafCardMaterial].cutout);
  // Each blade has a green of its own, which the painted views have in their image.
  EXPECT_TRUE(materials[kLeafMaterial].vertex_colours);
  EXPECT_TRUE(materials[kLeafCardMaterial].vertex_colours);
  EXPECT_FALSE(materials[kFoliageMaterial].vertex_colours);
  EXPECT_EQ(materials[kTrunkMaterial].translucency, 0);
}

TEST_F(GrapevineAssetTest, MeshesComeFirstThenCards) {
  const std::vector<LevelOfDetail>& levels = assets()[0].model.levels;
  ASSERT_EQ(levels.size(), 6u);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    std::set<int> materials;
    for (const Primitive& part : levels[i].primitives) materials.insert(part.material);
    EXPECT_EQ(materials.count(kLeafMaterial), 0u) << i;  // for painting alone
    EXPECT_EQ(materials.count(kLeafCardMaterial), i < 3 ? 1u : 0u) << i;
    EXPECT_EQ(materials.count(kFoliageMaterial), i < 3 ? 0u : 1u) << i;
    if (i == 0) continue;
    EXPECT_GT(levels[i].until, levels[i - 1].until);
    EXPECT_LT(triangle_count(levels[i]), triangle_count(levels[i - 1]));
  }
  EXPECT_EQ(levels.back().until, 1e9);
}

}  // namespace
}  // namespace vinebench::sim
