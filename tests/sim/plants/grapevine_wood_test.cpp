// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/plants/grapevine_wood.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/test_plant.h"

namespace vinebench::sim {
namespace {

struct Wood {
  Grapevine plant;
  std::vector<Bud> buds;
};

Wood grown(Training training, bool young = false) {
  PlantBrief brief = test::brief(89, training);
  brief.young = young;
  Wood wood;
  RandomSequence random(RandomStream(3, "wood"));
  wood.buds =
      young ? grow_young_wood(wood.plant, brief, random) : grow_old_wood(wood.plant, brief, random);
  return wood;
}

// 13 shoots a metre of row and a metre a plant.
TEST(GrapevineWoodTest, BudsAreAsManyAsShootsAskedFor) {
  for (const Training training : test::kTrainings) {
    EXPECT_EQ(grown(training).buds.size(), 13u);
  }
}

// A trunk, and an arm to each side that the cordon is led to; canes are last year's wood.
TEST(GrapevineWoodTest, TheTrainingSaysHowManyArmsOrCanes) {
  EXPECT_EQ(grown(Training::kBilateralCordon).plant.wood.size(), 3u);
  EXPECT_EQ(grown(Training::kUnilateralCordon).plant.wood.size(), 2u);
  const Grapevine single = grown(Training::kSingleGuyot).plant;
  EXPECT_EQ(single.wood.size(), 1u);
  EXPECT_EQ(single.canes.size(), 2u);  // and a renewal spur
  EXPECT_EQ(grown(Training::kDoubleGuyot).plant.canes.size(), 3u);
}

// Wood led to one side begins at that end of the plant's share, half a metre from its middle.
TEST(GrapevineWoodTest, TheFootStandsWhereTheTrainingHasIt) {
  const auto foot = [](Training training) {
    return grown(training).plant.wood.front().path.front().x();
  };
  EXPECT_NEAR(foot(Training::kBilateralCordon), 0, 0.06f);  // it may lean a little
  EXPECT_NEAR(foot(Training::kUnilateralCordon), -0.485f, 0.06f);
}

TEST(GrapevineWoodTest, BudsStandNearTheFruitingWire) {
  const auto wire = static_cast<float>(VinesConfig().lowest_bunch);
  for (const Training training : test::kTrainings) {
    for (const Bud& bud : grown(training).buds) {
      EXPECT_NEAR(bud.at.z(), wire, 0.15f);
      EXPECT_GT(bud.towards.z(), 0);  // shoots grow upwards
    }
  }
}

/// Canes of a dormant vine, by the share of pruned ones.
std::vector<Tube> dormant_canes(double pruned) {
  PlantBrief brief = test::brief(0, Training::kBilateralCordon);
  brief.vines.pruned = pruned;
  Grapevine plant;
  RandomSequence random(RandomStream(3, "wood"));
  grow_old_wood(plant, brief, random);
  return plant.canes;
}

// Seven spurs bear the 13 buds of a metre; each bud had a shoot, with side shoots on it.
TEST(GrapevineWoodTest, ADormantVineBearsItsCanesUntilItIsPruned) {
  EXPECT_EQ(dormant_canes(1).size(), 7u);
  const std::vector<Tube> canes = dormant_canes(0);
  EXPECT_GE(canes.size(), 7u + 13);
  float highest = 0;
  for (const Tube& cane : canes) {
    for (const Eigen::Vector3f& p : cane.path) {
      highest = std::max(highest, p.z());
      EXPECT_LE(std::abs(p.x()), 0.53f + 0.26f);  // its share, and a side shoot's length
    }
  }
  const auto top = static_cast<float>(VinesConfig().canopy_top);
  EXPECT_GT(highest, 0.85f * top);
  EXPECT_LT(highest, top + 0.35f);  // tips bend down above the wires
}

TEST(GrapevineWoodTest, AYoungVineIsAStemWithTwoBuds) {
  const Wood young = grown(Training::kBilateralCordon, true);
  EXPECT_EQ(young.plant.wood.size(), 1u);
  EXPECT_TRUE(young.plant.canes.empty());
  EXPECT_EQ(young.buds.size(), 2u);
  // Three quarters of the height of the lowest bunch, 0.03 m of it below the ground.
  const auto expected = static_cast<float>(0.75 * VinesConfig().lowest_bunch) - 0.03f;
  EXPECT_NEAR(young.plant.wood[0].path.back().z(), expected, 1e-5f);
}

}  // namespace
}  // namespace vinebench::sim
