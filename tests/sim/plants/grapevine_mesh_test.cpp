// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/plants/grapevine_mesh.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "sim/assets/asset_file.h"
#include "tests/support/test_folder.h"
#include "tests/support/test_plant.h"

namespace vinebench::sim {
namespace {

using test::brief;
using test::for_each_primitive;
using test::kCodes;
using test::kSeeds;
using test::kTrainings;
using test::label_of;
using test::plant;

// Vertices are floats, with a relative precision of 1e-7.
constexpr float kRounding = 1e-5f;  // m

TEST(GrapevineMeshTest, TheLowestBerryHangsExactlyWhereTheWorldSays) {
  for (const std::uint64_t seed : kSeeds) {
    const Asset asset = plant(brief(), seed);
    for (int level = 0; level < 3; ++level) {
      float lowest = std::numeric_limits<float>::max();
      for (const Primitive& primitive : asset.model.levels.at(level).primitives) {
        if (label_of(asset, primitive) != Label::kBunch) continue;
        for (const Vertex& v : primitive.vertices) lowest = std::min(lowest, v.position.z());
      }
      EXPECT_NEAR(lowest, 0.60f, kRounding) << "seed " << seed << ", level " << level;
    }
  }
}

TEST(GrapevineMeshTest, TheCanopyKeepsToItsDepthAndHeight) {
  PlantBrief narrow = brief();
  narrow.vines.canopy_depth = 0.16;
  narrow.vines.canopy_top = 1.2;
  narrow.vines.lowest_bunch = 0.5;
  for (const PlantBrief& each : {brief(), narrow}) {
    const auto half = static_cast<float>(each.vines.canopy_depth / 2 / kLargestPlantScale);
    // The shoots' tips end at canopy_top, or half a step of 0.09 m later; the last leaves extend
    // beyond by at most the length of one: 0.122 m.
    const auto top = static_cast<float>(each.vines.canopy_top) + 0.045f + 0.122f;
    for (const std::uint64_t seed : kSeeds) {
      float highest = 0;
      for_each_primitive(plant(each, seed), [&](const Primitive& primitive, Label) {
        for (const Vertex& v : primitive.vertices) {
          ASSERT_LE(std::abs(v.position.y()), half + kRounding);
          ASSERT_LE(v.position.z(), top);
          ASSERT_GE(v.position.z(), -0.05f);  // the trunk begins in the soil
          highest = std::max(highest, v.position.z());
        }
      });
      EXPECT_GT(highest, static_cast<float>(each.vines.canopy_top) - 0.1f);
    }
  }
}

/// Opacity of a leaf's image at a vertex, 0 to 255.
int opacity(const Vertex& vertex) {
  const cv::Mat& image = test::textures().at(kLeafTexture).rgba;
  const auto at = [](float share, int size) {
    return std::min(static_cast<int>(share * static_cast<float>(size)), size - 1);
  };
  return image.at<cv::Vec4b>(at(vertex.uv.y(), image.rows), at(vertex.uv.x(), image.cols))[3];
}

TEST(GrapevineMeshTest, NoLeafHangsIntoTheWayBelowTheFruit) {
  for (const std::uint64_t seed : kSeeds) {
    int seen = 0;
    for_each_primitive(plant(brief(), seed), [&](const Primitive& primitive, Label) {
      if (primitive.material != kLeafCardMaterial) return;
      // 2 cm below the lowest bunch; the waves of a blade's rim may hang by 3 cm more.
      for (const Vertex& v : primitive.vertices) {
        if (opacity(v) < 128) continue;
        ASSERT_GT(v.position.z(), 0.60f - 0.02f - 0.03f);
        ++seen;
      }
    });
    EXPECT_GT(seen, 100);
  }
}

void expect_sound(const Asset& asset) {
  for_each_primitive(asset, [&](const Primitive& primitive, Label) {
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

TEST(GrapevineMeshTest, EveryTrainingAndStageIsSoundAndWithinTheRenderersBudget) {
  constexpr std::array<int, 6> kMost{40000, 7000, 2500, 350, 60, 12};
  for (const Training training : kTrainings) {
    for (const int code : kCodes) {
      for (const bool young : {false, true}) {
        PlantBrief each = brief(code, training);
        each.young = young;
        const Asset asset = plant(each, 11);
        SCOPED_TRACE(testing::Message() << yaml_names(training).at(static_cast<int>(training))
                                        << ", BBCH " << code << (young ? ", young" : ""));
        expect_sound(asset);
        ASSERT_EQ(asset.model.levels.size(), kMost.size());
        for (std::size_t i = 0; i < kMost.size(); ++i) {
          EXPECT_LE(triangle_count(asset.model.levels[i]), kMost[i]) << "level " << i;
          EXPECT_GT(triangle_count(asset.model.levels[i]), 0) << "level " << i;
          const double nearer = i > 0 ? asset.model.levels[i - 1].until : 0;
          EXPECT_GT(asset.model.levels[i].until, nearer);
        }
      }
    }
  }
}

TEST(GrapevineMeshTest, BoundsHoldTheFinestLevel) {
  const Asset asset = plant(brief(), 1);
  for (const Primitive& primitive : asset.model.levels[0].primitives) {
    for (const Vertex& v : primitive.vertices) EXPECT_TRUE(asset.model.bounds.contains(v.position));
  }
}

TEST(GrapevineMeshTest, ASeedAndAnIndexAreOnePlant) {
  const std::string first = to_glb(plant(brief(), 1, 0));
  EXPECT_EQ(first, to_glb(plant(brief(), 1, 0)));
  EXPECT_NE(first, to_glb(plant(brief(), 2, 0)));
  EXPECT_NE(first, to_glb(plant(brief(), 1, 1)));
}

TEST(GrapevineMeshTest, EachBunchIsAPartThatAFileKeeps) {
  const Grapevine vine = grow_grapevine(brief(), 1, 0);
  const Asset asset = plant(brief(), 1);
  const test::TestFolder folder;
  const Asset read = load_asset(folder.write("vine.glb", to_glb(asset)));
  for (int level = 0; level < 3; ++level) {
    std::set<int> parts;
    const LevelOfDetail& from = asset.model.levels.at(level);
    for (std::size_t p = 0; p < from.primitives.size(); ++p) {
      const Primitive& primitive = from.primitives[p];
      const Primitive& kept = read.model.levels.at(level).primitives.at(p);
      for (std::size_t i = 0; i < primitive.vertices.size(); ++i) {
        ASSERT_EQ(primitive.vertices[i].part, kept.vertices.at(i).part);
        if (label_of(asset, primitive) == Label::kBunch) {
          parts.insert(kept.vertices[i].part);
        } else {
          ASSERT_EQ(kept.vertices[i].part, 0);
        }
      }
    }
    ASSERT_EQ(parts.size(), vine.bunches.size());
    EXPECT_EQ(*parts.begin(), 1);
    EXPECT_EQ(*parts.rbegin(), static_cast<int>(vine.bunches.size()));
  }
}

}  // namespace
}  // namespace vinebench::sim
