// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "sim/plants/grapevine_mesh.h"
#include "tests/support/test_plant.h"

namespace vinebench::sim {
namespace {

/// Cards of some plants, painted with the textures and materials of their assets.
class GrapevineCardsTest : public testing::Test {
 protected:
  static std::vector<Grapevine> grown(int count, int bbch = 89) {
    std::vector<Grapevine> plants;
    for (int i = 0; i < count; ++i) plants.push_back(grow_grapevine(test::brief(bbch), 1, i));
    return plants;
  }
  static const std::vector<Material>& materials() {
    static const std::vector<Material> kMaterials = test::plant(test::brief(), 1).materials;
    return kMaterials;
  }
  static FarPlants cards_of(const std::vector<Grapevine>& plants) {
    return {plants, test::textures(), materials()};
  }
  /// The cards of a level; none where it has no foliage.
  static Primitive foliage_of(const LevelOfDetail& level) {
    for (const Primitive& part : level.primitives) {
      if (part.material == kFoliageMaterial) return part;
    }
    return {};
  }
};

TEST_F(GrapevineCardsTest, LevelsGetCoarserToTheHorizon) {
  const std::vector<Grapevine> plants = grown(1);
  const std::vector<LevelOfDetail> levels = cards_of(plants).levels(0);
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_LT(levels[0].until, levels[1].until);
  EXPECT_EQ(levels[2].until, 1e9);
  const std::vector<std::size_t> squares{4 * 6, 2 * 3, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    // Two sheets of squares, and two cards across the row.
    EXPECT_EQ(foliage_of(levels[i]).indices.size() / 3, 2 * (2 * squares[i] + 2)) << i;
  }
}

TEST_F(GrapevineCardsTest, SheetsLieWithinTheCanopyAndFaceOutward) {
  const std::vector<Grapevine> plants = grown(1);
  Eigen::AlignedBox3f canopy;
  for (const Primitive& part : mesh_to_paint(plants[0], CanopyLight(plants[0].leaves))) {
    for (const Vertex& v : part.vertices) canopy.extend(v.position);
  }
  Eigen::AlignedBox3f cards;
  const Primitive foliage = foliage_of(cards_of(plants).levels(0)[0]);
  for (const Vertex& v : foliage.vertices) {
    cards.extend(v.position);
    EXPECT_NEAR(v.normal.norm(), 1, 1e-6);
    EXPECT_GT(v.occlusion, 0);
    EXPECT_LE(v.occlusion, 1);
  }
  // The halves' boxes together are the canopy's; depths are means, so that sheets lie inside.
  canopy.min().array() -= 1e-4f;
  canopy.max().array() += 1e-4f;
  EXPECT_TRUE(canopy.contains(cards));
  EXPECT_NEAR(cards.sizes().x(), canopy.sizes().x(), 0.05f * canopy.sizes().x());
  EXPECT_NEAR(cards.sizes().z(), canopy.sizes().z(), 0.05f * canopy.sizes().z());
}

/// Each plant has a cell of 512 x 256 px; in it, four cards that do not touch.
TEST_F(GrapevineCardsTest, EveryPlantHasItsOwnCellOfTheImage) {
  const std::vector<Grapevine> plants = grown(3);
  const FarPlants far = cards_of(plants);
  const cv::Mat& image = far.texture().rgba;
  EXPECT_EQ(image.size(), cv::Size(2 * 512, 2 * 256));
  EXPECT_FALSE(far.texture().repeat);
  for (std::size_t i = 0; i < 3; ++i) {
    const cv::Rect cell(static_cast<int>(i % 2) * 512, static_cast<int>(i / 2) * 256, 512, 256);
    Eigen::AlignedBox2f used;
    const Primitive foliage = foliage_of(far.levels(i)[0]);
    for (const Vertex& v : foliage.vertices) {
      used.extend(Eigen::Vector2f(v.uv.x() * static_cast<float>(image.cols),
                                  v.uv.y() * static_cast<float>(image.rows)));
    }
    // The rim of 2 px keeps neighbours out of each other's mip levels.
    EXPECT_NEAR(used.min().x(), static_cast<float>(cell.x + 2), 0.01);
    EXPECT_NEAR(used.min().y(), static_cast<float>(cell.y + 2), 0.01);
    EXPECT_NEAR(used.max().x(), static_cast<float>(cell.br().x - 2), 0.01);
    EXPECT_NEAR(used.max().y(), static_cast<float>(cell.br().y - 2), 0.01);
    cv::Mat alpha;
    cv::extractChannel(image(cell), alpha, 3);
    EXPECT_GT(cv::countNonZero(alpha), cell.area() / 10);
    EXPECT_EQ(cv::countNonZero(alpha.col(191)) + cv::countNonZero(alpha.col(192)), 0);
  }
  EXPECT_EQ(cv::countNonZero(image(cv::Rect(512, 256, 512, 256)).clone().reshape(1)), 0);
}

TEST_F(GrapevineCardsTest, AVineWithoutLeavesIsWoodAtEveryDistance) {
  const std::vector<Grapevine> plants = grown(1, 0);
  for (const LevelOfDetail& level : cards_of(plants).levels(0)) {
    EXPECT_FALSE(level.primitives.empty());
    for (const Primitive& part : level.primitives) EXPECT_NE(part.material, kBunchMaterial);
  }
}

}  // namespace
}  // namespace vinebench::sim
