// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/grapevine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <opencv2/core.hpp>
#include <set>

#include "sim/asset_file.h"
#include "sim/textures.h"
#include "slam/base/error.h"
#include "tests/sim/test_folder.h"

namespace vinebench {
namespace {

constexpr std::array<Training, 4> kTrainings{Training::kBilateralCordon,
                                             Training::kUnilateralCordon, Training::kSingleGuyot,
                                             Training::kDoubleGuyot};
constexpr std::array<int, 7> kCodes{0, 9, 65, 75, 83, 89, 95};
constexpr std::array<std::uint64_t, 4> kSeeds{1, 2, 77, 123456789};
// Vertices are floats: a metre is known to 1e-7.
constexpr float kRounding = 1e-5f;  // m

PlantBrief brief(int bbch = 89, Training training = Training::kBilateralCordon) {
  PlantBrief brief;
  brief.vines.bbch = bbch;
  brief.vines.training = training;
  brief.stage = growth_stage(bbch);
  return brief;
}

/// Painted once: every test that does not look at them uses the same ones.
const std::vector<Texture>& textures() {
  static const std::vector<Texture> kTextures = plant_textures({}, growth_stage(89), 1);
  return kTextures;
}

Asset plant(const PlantBrief& brief, std::uint64_t seed, int index = 0) {
  return mesh_grapevines({grow_grapevine(brief, seed, index)}, textures()).at(0);
}

Label label_of(const Asset& asset, const Primitive& primitive) {
  return asset.materials.at(static_cast<std::size_t>(primitive.material)).label;
}

template <class Visit>
void for_each_primitive(const Asset& asset, const Visit& visit) {
  for (const LevelOfDetail& level : asset.model.levels) {
    for (const Primitive& primitive : level.primitives)
      visit(primitive, label_of(asset, primitive));
  }
}

bool has(const Asset& asset, Label label) {
  bool found = false;
  for_each_primitive(asset, [&](const Primitive&, Label other) { found |= other == label; });
  return found;
}

TEST(GrapevineTest, TheLowestBerryHangsExactlyWhereTheWorldSays) {
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

TEST(GrapevineTest, TheCanopyKeepsToItsDepthAndHeight) {
  PlantBrief narrow = brief();
  narrow.vines.canopy_depth = 0.16;
  narrow.vines.canopy_top = 1.2;
  narrow.vines.lowest_bunch = 0.5;
  for (const PlantBrief& each : {brief(), narrow}) {
    const auto half = static_cast<float>(each.vines.canopy_depth / 2 / kLargestPlantScale);
    // The shoots' tips end at canopy_top, or half a step of 0.09 m later; the last leaves rise from
    // there by at most the length of one: 0.122 m.
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

TEST(GrapevineTest, NoLeafHangsIntoTheWayBelowTheFruit) {
  for (const std::uint64_t seed : kSeeds) {
    for_each_primitive(plant(brief(), seed), [&](const Primitive& primitive, Label label) {
      if (label != Label::kLeaf) return;
      // 2 cm below the lowest bunch; a coarse outline of the same area may hang by 3 cm more.
      for (const Vertex& v : primitive.vertices) ASSERT_GT(v.position.z(), 0.60f - 0.02f - 0.03f);
    });
  }
}

TEST(GrapevineTest, ShootsAndBunchesAreAsManyAsAskedFor) {
  for (const Training training : kTrainings) {
    for (const double spacing : {0.8, 1.0, 1.4}) {
      PlantBrief asked = brief(89, training);
      asked.vines.spacing = spacing;
      asked.vines.shoots = 15;
      asked.vines.bunches = 1.2;
      double shoots = 0, bunches = 0;
      for (const std::uint64_t seed : kSeeds) {
        const Grapevine vine = grow_grapevine(asked, seed, 0);
        shoots += static_cast<double>(vine.shoots.size());
        bunches += static_cast<double>(vine.bunches.size());
      }
      EXPECT_NEAR(shoots / (kSeeds.size() * spacing), 15, 1) << "one shoot of 0.8 m is 1.25";
      // Bunches that would hang into each other are left out.
      EXPECT_LE(bunches / shoots, 1.3);
      EXPECT_GE(bunches / shoots, 0.85);
    }
  }
}

TEST(GrapevineTest, LeafAreaIsThatOfTheRow) {
  for (const Training training : kTrainings) {
    for (const double wanted : {1.5, 2.0, 3.0}) {
      PlantBrief asked = brief(89, training);
      asked.vines.leaf_area = wanted;
      asked.vines.leaf_removal = 0;
      const double area = leaf_area(grow_grapevine(asked, 5, 0)) / asked.vines.spacing;
      // Within a leaf or two of 0.01 m^2, and the spread of the lobes' depth.
      EXPECT_NEAR(area, wanted, 0.06 * wanted);
    }
  }
}

TEST(GrapevineTest, LeavesOfOneMetreOfRowStayWithinPractice) {
  // Single canopies: 2 to 5 m^2 a metre (Kliewer and Dokoozlian); half of the fruit zone's taken.
  const double area = leaf_area(grow_grapevine(brief(), 1, 0));
  EXPECT_GT(area, 1.4);
  EXPECT_LE(area, 2.1);
  double largest = 0;
  const Grapevine vine = grow_grapevine(brief(), 1, 0);
  for (const BladePlacement& leaf : vine.leaves) {
    largest = std::max(largest,
                       static_cast<double>(leaf_outline_area(leaf.lobes) * leaf.size * leaf.size));
  }
  EXPECT_GT(largest, 0.010);
  EXPECT_LT(largest, 0.020);
}

TEST(GrapevineTest, LeafRemovalThinsTheFruitZoneOnly) {
  const auto leaves = [](double removed, bool fruit_zone) {
    PlantBrief asked = brief();
    asked.vines.leaf_removal = removed;
    int count = 0;
    for (const std::uint64_t seed : kSeeds) {
      const Grapevine vine = grow_grapevine(asked, seed, 0);
      for (const Petiole& petiole : vine.petioles)
        count += (petiole.from.z() < 0.86f) == fruit_zone;
    }
    return count;
  };
  EXPECT_EQ(leaves(1, true), 0);
  EXPECT_GT(leaves(0, true), 100);
  EXPECT_NEAR(leaves(0.5, true), 0.5 * leaves(0, true), 0.12 * leaves(0, true));
  EXPECT_EQ(leaves(1, false), leaves(0, false));
}

TEST(GrapevineTest, BunchesHangOnlyBetweenFloweringAndHarvest) {
  for (const int code : kCodes) {
    const Asset asset = plant(brief(code), 3);
    EXPECT_EQ(has(asset, Label::kBunch), code >= 65 && code <= 89) << code;
    EXPECT_TRUE(has(asset, Label::kTrunk)) << code;
    EXPECT_TRUE(has(asset, Label::kCane)) << code;
  }
}

TEST(GrapevineTest, ADormantVineIsOldWoodAlone) {
  for (const Training training : kTrainings) {
    const Grapevine vine = grow_grapevine(brief(0, training), 3, 0);
    EXPECT_TRUE(vine.leaves.empty());
    EXPECT_TRUE(vine.shoots.empty());
    EXPECT_TRUE(vine.bunches.empty());
    EXPECT_FALSE(vine.wood.empty());
    EXPECT_FALSE(vine.canes.empty());
  }
}

TEST(GrapevineTest, TheYearGoesFromBareToFullToThin) {
  std::vector<double> area;
  for (const int code : kCodes) {
    PlantBrief asked = brief(code);
    asked.vines.leaf_removal = 0;
    area.push_back(leaf_area(grow_grapevine(asked, 3, 0)));
  }
  EXPECT_EQ(area[0], 0);
  EXPECT_GT(area[1], 0);
  EXPECT_LT(area[1], 0.05);
  EXPECT_LT(area[1], area[2]);
  EXPECT_LT(area[2], area[3]);
  EXPECT_LE(area[3], 1.05 * area[4]);
  EXPECT_NEAR(area[6], 0.5 * area[5], 0.12 * area[5]) << "half of the leaves have fallen";
}

TEST(GrapevineTest, AnUnknownStageIsRefusedWithTheKnownOnes) {
  EXPECT_THAT(test::error_of([] { growth_stage(50); }),
              testing::AllOf(testing::HasSubstr("0 (dormant)"),
                             testing::HasSubstr("95 (leaf fall)"), testing::HasSubstr("found 50")));
  VinesConfig vines;
  vines.bbch = 50;
  EXPECT_THROW(validate(vines), Error);
}

TEST(GrapevineTest, WoodKeepsToThePlantsShareOfTheRow) {
  for (const Training training : kTrainings) {
    const Grapevine vine = grow_grapevine(brief(0, training), 8, 0);
    for (const Tube& tube : vine.wood) {
      for (const Eigen::Vector3f& p : tube.path) ASSERT_LE(std::abs(p.x()), 0.53f);
    }
    const bool both = training == Training::kBilateralCordon || training == Training::kDoubleGuyot;
    const float foot = vine.wood.at(0).path.at(0).x();
    EXPECT_NEAR(foot, both ? 0.0f : -0.485f, 0.05f);
    float end = 0;  // of what lies along the wire
    for (const auto* tubes : {&vine.wood, &vine.canes}) {
      for (const Tube& tube : *tubes) end = std::max(end, tube.path.back().x());
    }
    EXPECT_GT(end, 0.44f);
  }
}

TEST(GrapevineTest, AYoungVineIsSmall) {
  PlantBrief young = brief();
  young.young = true;
  const Grapevine vine = grow_grapevine(young, 1, 0), grown = grow_grapevine(brief(), 1, 0);
  EXPECT_TRUE(vine.bunches.empty());
  EXPECT_GT(vine.leaves.size(), 3u);
  EXPECT_LT(leaf_area(vine), 0.25 * leaf_area(grown));
  EXPECT_LT(vine.wood.at(0).radii.at(0), 0.5f * grown.wood.at(0).radii.at(0));
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

TEST(GrapevineTest, EveryTrainingAndStageIsSoundAndWithinTheRenderersBudget) {
  constexpr std::array<int, 6> kMost{14000, 7000, 2500, 350, 60, 12};
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

TEST(GrapevineTest, BoundsHoldTheFinestLevel) {
  const Asset asset = plant(brief(), 1);
  for (const Primitive& primitive : asset.model.levels[0].primitives) {
    for (const Vertex& v : primitive.vertices) EXPECT_TRUE(asset.model.bounds.contains(v.position));
  }
}

TEST(GrapevineTest, EverySideOfTheRowIsTheSameToTheGrower) {
  // Leaves hang to both sides: over several plants, neither has more than 1.5 times the other's.
  int left = 0, right = 0;
  for (const std::uint64_t seed : kSeeds) {
    for (const BladePlacement& leaf : grow_grapevine(brief(), seed, 0).leaves) {
      ++(leaf.foot.y() > 0 ? left : right);
    }
  }
  EXPECT_LT(2 * left, 3 * right);
  EXPECT_LT(2 * right, 3 * left);
}

TEST(GrapevineTest, ASeedAndAnIndexAreOnePlant) {
  const std::string first = to_glb(plant(brief(), 1, 0));
  EXPECT_EQ(first, to_glb(plant(brief(), 1, 0)));
  EXPECT_NE(first, to_glb(plant(brief(), 2, 0)));
  EXPECT_NE(first, to_glb(plant(brief(), 1, 1)));
}

TEST(GrapevineTest, EachBunchIsAPartThatAFileKeeps) {
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

TEST(CultivarTest, ThoseThatAreShippedCanBeReadAndGrown) {
  for (const char* name : {"merlot", "chardonnay", "riesling"}) {
    const auto file =
        std::filesystem::path(VINEBENCH_SOURCE_DIR) / "cultivars" / (std::string(name) + ".yaml");
    PlantBrief asked = brief();
    asked.cultivar = load_cultivar(file);
    EXPECT_EQ(asked.cultivar.name, name);
    const Grapevine vine = grow_grapevine(asked, 1, 0);
    double length = 0;
    for (const Bunch& bunch : vine.bunches) length += static_cast<double>(bunch.length);
    // The mean of a dozen bunches whose lengths differ by 13 %: 4 % times three.
    EXPECT_NEAR(length / static_cast<double>(vine.bunches.size()), asked.cultivar.bunch.length,
                0.12 * asked.cultivar.bunch.length);
  }
}

TEST(CultivarTest, AnUnknownKeyIsNamed) {
  const test::TestFolder folder;
  const auto file = folder.write("odd.yaml", "leaf: {colour: green}\n");
  EXPECT_THAT(test::error_of([&] { load_cultivar(file); }), testing::HasSubstr("leaf.colour"));
}

TEST(PlantTexturesTest, ASeedIsOneSetOfPictures) {
  const std::vector<Texture> again = plant_textures({}, growth_stage(89), 1);
  const std::vector<Texture> other = plant_textures({}, growth_stage(89), 2);
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
