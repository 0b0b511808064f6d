// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/asset.h"

#include <gtest/gtest.h>

#include "tests/support/broken_files.h"

namespace vinebench::sim {
namespace {

TEST(AssetTest, BoundsAreOfTheFinestLevelThatHasVertices) {
  Asset asset;
  Primitive fine, coarse;
  fine.vertices = {{{-1, 0, 0}, {0, 0, 1}}, {{2, 3, 4}, {0, 0, 1}}};
  coarse.vertices = {{{9, 9, 9}, {0, 0, 1}}};
  asset.model.levels = {{1, {}}, {2, {fine}}, {3, {coarse}}};
  asset.update_bounds();
  EXPECT_EQ(asset.model.bounds.min(), Eigen::Vector3f(-1, 0, 0));
  EXPECT_EQ(asset.model.bounds.max(), Eigen::Vector3f(2, 3, 4));
}

TEST(AssetTest, EqualTexturesAndMaterialsAreShared) {
  Scene scene;
  EXPECT_EQ(add_asset(scene, test::small_plant()), 0);
  EXPECT_EQ(add_asset(scene, test::small_plant()), 1);
  EXPECT_EQ(scene.models.size(), 2u);
  EXPECT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.materials.size(), 2u);
}

TEST(AssetTest, OneOtherBitIsAnotherTexture) {
  Scene scene;
  add_asset(scene, test::small_plant());
  Asset other = test::small_plant();
  other.textures[0].rgba = other.textures[0].rgba.clone();
  other.textures[0].rgba.at<cv::Vec4b>(3, 3)[0] ^= 1;
  add_asset(scene, other);
  ASSERT_EQ(scene.textures.size(), 2u);
  // Its leaves are another material, for they name that texture; the bark has none and is shared.
  ASSERT_EQ(scene.materials.size(), 3u);
  EXPECT_EQ(scene.materials[2].texture, 1);
  const std::vector<Primitive>& parts = scene.models[1].levels[0].primitives;
  EXPECT_EQ(parts[0].material, 1);
  EXPECT_EQ(parts[1].material, 2);
}

TEST(AssetTest, TrianglesAreAThirdOfTheIndices) {
  Primitive two, one;
  two.indices = {0, 1, 2, 0, 2, 3};
  one.indices = {0, 1, 2};
  EXPECT_EQ(triangle_count({1, {two, one}}), 3);
}

}  // namespace
}  // namespace vinebench::sim
