// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/plants/grapevine.h"

#include <gtest/gtest.h>

#include "tests/support/test_plant.h"

namespace vinebench::sim {
namespace {

using test::brief;
using test::has;
using test::kCodes;
using test::kSeeds;
using test::kTrainings;
using test::plant;

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
      // Bunches that would intersect are left out.
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
  // Single canopies: 2 to 5 m^2 a metre (Kliewer and Dokoozlian); half of the fruit zone's removed.
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
  ASSERT_EQ(kCodes[6], 89);
  EXPECT_NEAR(area[7], 0.5 * area[6], 0.12 * area[6]) << "half of the leaves have fallen";
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
    float end = 0;  // of the canes along the wire
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

}  // namespace
}  // namespace vinebench::sim
