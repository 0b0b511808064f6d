// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/grapevine.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <opencv2/core.hpp>

#include "sim/asset_file.h"
#include "sim/textures.h"

namespace vinebench {
namespace {

/// Painted once: every test uses the same ones.
const std::vector<Texture>& textures() {
  static const std::vector<Texture> kTextures = plant_textures(1);
  return kTextures;
}

Asset plant(std::uint64_t seed, int index = 0, const WorldConfig::Vines& vines = {}) {
  return mesh_grapevine(grow_grapevine(vines, seed, index), textures());
}

template <class Visit>
void for_each_primitive(const Asset& asset, const Visit& visit) {
  for (const LevelOfDetail& level : asset.model.levels) {
    for (const Primitive& primitive : level.primitives) {
      visit(primitive, asset.materials.at(static_cast<std::size_t>(primitive.material)).label);
    }
  }
}

constexpr std::array<std::uint64_t, 5> kSeeds{1, 2, 3, 77, 123456789};
// Vertices are floats: a metre is known to 1e-7.
constexpr float kRounding = 1e-5f;  // m

TEST(GrapevineTest, TheLowestBerryHangsWhereTheWorldSays) {
  for (const std::uint64_t seed : kSeeds) {
    const Asset asset = plant(seed);
    for (const LevelOfDetail& level : asset.model.levels) {
      float lowest = std::numeric_limits<float>::max();
      for (const Primitive& primitive : level.primitives) {
        if (asset.materials.at(static_cast<std::size_t>(primitive.material)).label != Label::kBunch)
          continue;
        for (const Vertex& v : primitive.vertices) lowest = std::min(lowest, v.position.z());
      }
      EXPECT_GE(lowest, 0.60f - kRounding) << "seed " << seed;
      // Never more than 1 cm higher: the dome of a berry stops a little past its equator.
      EXPECT_LT(lowest, 0.61f) << "seed " << seed;
    }
  }
}

TEST(GrapevineTest, TheCanopyKeepsToItsDepthAndHeight) {
  WorldConfig::Vines narrow;
  narrow.canopy_depth = 0.16;
  narrow.canopy_top = 1.2;
  narrow.lowest_bunch = 0.5;
  for (const WorldConfig::Vines& vines : {WorldConfig::Vines{}, narrow}) {
    const auto half = static_cast<float>(vines.canopy_depth / 2 / kLargestPlantScale);
    // The shoots' tips end at canopy_top at the latest; the last leaves rise from there by at most
    // the length of one: 0.122 m.
    const auto top = static_cast<float>(vines.canopy_top) + 0.122f;
    for (const std::uint64_t seed : kSeeds) {
      for_each_primitive(plant(seed, 0, vines), [&](const Primitive& primitive, Label) {
        for (const Vertex& v : primitive.vertices) {
          ASSERT_LE(std::abs(v.position.y()), half + kRounding);
          ASSERT_LE(v.position.z(), top);
          ASSERT_GE(v.position.z(), -0.05f);  // the trunk begins in the soil
        }
      });
    }
  }
}

TEST(GrapevineTest, NoLeafHangsIntoTheWayBelowTheFruit) {
  for (const std::uint64_t seed : kSeeds) {
    for_each_primitive(plant(seed), [&](const Primitive& primitive, Label label) {
      if (label != Label::kLeaf) return;
      // 2 cm below the lowest bunch; clumps of the farthest level may hang by a leaf's length more.
      for (const Vertex& v : primitive.vertices) ASSERT_GT(v.position.z(), 0.60f - 0.02f - 0.12f);
    });
  }
}

TEST(GrapevineTest, TrianglesStayWithinTheRenderersBudget) {
  // A picture of the default world holds a plant or two of the first level, four of the second and
  // all others of the last two.
  constexpr std::array<int, 4> kMost{22000, 8000, 2500, 600};
  for (const std::uint64_t seed : kSeeds) {
    const Asset asset = plant(seed);
    ASSERT_EQ(asset.model.levels.size(), kMost.size());
    for (std::size_t i = 0; i < kMost.size(); ++i) {
      EXPECT_LE(triangle_count(asset.model.levels[i]), kMost[i]);
      EXPECT_GT(triangle_count(asset.model.levels[i]), kMost[i] / 4);
    }
    for (std::size_t i = 1; i < kMost.size(); ++i) {
      EXPECT_GT(asset.model.levels[i].until, asset.model.levels[i - 1].until);
    }
  }
}

TEST(GrapevineTest, MeshesAreSound) {
  for (const std::uint64_t seed : kSeeds) {
    for_each_primitive(plant(seed), [&](const Primitive& primitive, Label) {
      ASSERT_EQ(primitive.indices.size() % 3, 0u);
      for (const std::uint32_t i : primitive.indices) ASSERT_LT(i, primitive.vertices.size());
      for (const Vertex& v : primitive.vertices) {
        ASSERT_TRUE(v.position.allFinite() && v.normal.allFinite() && v.uv.allFinite());
        ASSERT_NEAR(v.normal.norm(), 1, 1e-4);
        ASSERT_GE(v.occlusion, 0.0f);
        ASSERT_LE(v.occlusion, 1.0f);
      }
    });
  }
}

TEST(GrapevineTest, BoundsHoldEveryLevelOfBerriesAndWood) {
  const Asset asset = plant(1);
  for (const Primitive& primitive : asset.model.levels[0].primitives) {
    for (const Vertex& v : primitive.vertices) EXPECT_TRUE(asset.model.bounds.contains(v.position));
  }
}

TEST(GrapevineTest, EverySideOfTheRowIsTheSameToTheGrower) {
  // Leaves and bunches hang to both sides: over several plants, neither has more than twice the
  // other's.
  int left = 0, right = 0;
  for (const std::uint64_t seed : kSeeds) {
    for (const BladePlacement& leaf : grow_grapevine({}, seed, 0).leaves) {
      ++(leaf.foot.y() > 0 ? left : right);
    }
  }
  EXPECT_LT(left, 2 * right);
  EXPECT_LT(right, 2 * left);
}

TEST(GrapevineTest, ASeedAndAnIndexAreOnePlant) {
  const std::string first = to_glb(plant(1, 0));
  EXPECT_EQ(first, to_glb(plant(1, 0)));
  EXPECT_NE(first, to_glb(plant(2, 0)));
  EXPECT_NE(first, to_glb(plant(1, 1)));
  EXPECT_NE(to_glb(plant(1, 1)), to_glb(plant(1, 2)));
}

TEST(PlantTexturesTest, ASeedIsOneSetOfPictures) {
  const std::vector<Texture> again = plant_textures(1), other = plant_textures(2);
  for (std::size_t i = 0; i < again.size(); ++i) {
    EXPECT_EQ(cv::norm(textures()[i].rgba, again[i].rgba, cv::NORM_INF), 0) << again[i].name;
    EXPECT_GT(cv::norm(textures()[i].rgba, other[i].rgba, cv::NORM_INF), 0) << again[i].name;
  }
}

TEST(PlantTexturesTest, LeavesAreGreenInsideTheirOutline) {
  const Texture& leaves = textures().at(2);
  ASSERT_EQ(leaves.name, "leaf");
  const TextureCell cell = leaf_cell(0);
  const Eigen::Vector2f middle = cell.at(0.5f, 0.5f), corner = cell.at(0.02f, 0.02f);
  const auto texel = [&](const Eigen::Vector2f& uv) {
    return leaves.rgba.at<cv::Vec4b>(static_cast<int>(uv.y() * leaves.rgba.rows),
                                     static_cast<int>(uv.x() * leaves.rgba.cols));
  };
  EXPECT_EQ(texel(middle)[3], 255);
  EXPECT_GT(texel(middle)[1], texel(middle)[0]);
  EXPECT_GT(texel(middle)[1], texel(middle)[2]);
  EXPECT_EQ(texel(corner)[3], 0);
}

}  // namespace
}  // namespace vinebench
