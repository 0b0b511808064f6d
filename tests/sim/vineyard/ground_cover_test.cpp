// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <map>

#include "sim/assets/asset.h"
#include "sim/vineyard/ground.h"
#include "sim/world/row_index.h"

namespace vinebench::sim {
namespace {

class GroundCoverTest : public testing::Test {
 protected:
  GroundCoverTest() { world_.rows = {{{0, 0}, {6, 0}}, {{0, 2}, {6, 2}}}; }

  Scene cover(std::uint64_t seed = 1) const {
    Scene scene;
    add_ground_cover(scene, world_, lay_out(world_), seed);
    return scene;
  }
  /// Places by the kind of patch.
  static std::map<std::string, std::vector<Eigen::Vector3d>> places(const Scene& scene) {
    std::map<std::string, std::vector<Eigen::Vector3d>> found;
    for (const Instance& instance : scene.instances) {
      found[scene.models.at(static_cast<std::size_t>(instance.model)).name].push_back(
          instance.T_world_model.translation);
    }
    return found;
  }
  void set_grass() { world_.ground.aisles = GroundConfig::Aisles::kGrass; }
  WorldConfig world_;
};

TEST_F(GroundCoverTest, WeedsStandInEveryMetreOfARow) {
  const std::vector<Eigen::Vector3d> weeds = places(cover())["weeds"];
  ASSERT_EQ(weeds.size(), 12u);
  for (std::size_t i = 0; i < weeds.size(); ++i) {
    const Eigen::Vector3d expected(0.5 + static_cast<double>(i % 6), i < 6 ? 0 : 2, 0);
    EXPECT_LT((weeds[i] - expected).norm(), 1e-9) << i;
  }
}

TEST_F(GroundCoverTest, BareSoilHasLitterNearTheVinesAndGrassBeyond) {
  auto found = places(cover());
  EXPECT_EQ(found.count("mown") + found.count("fringe"), 0u);
  const RowIndex rows(world_.rows);
  EXPECT_GT(found["litter"].size(), 10u);
  for (const Eigen::Vector3d& p : found["litter"]) EXPECT_LT(rows.distance(p.head<2>()), 1.2);
  EXPECT_GT(found["grass"].size(), 10u);
  for (const Eigen::Vector3d& p : found["grass"]) EXPECT_GE(rows.distance(p.head<2>()), 1.2);
}

TEST_F(GroundCoverTest, GrassAislesAreMownBetweenTheirFringes) {
  set_grass();
  auto found = places(cover());
  EXPECT_EQ(found.count("litter"), 0u);
  // A strip of 6 patches in the middle between the two rows.
  ASSERT_EQ(found["mown"].size(), 6u);
  for (const Eigen::Vector3d& p : found["mown"]) EXPECT_NEAR(p.y(), 1, 1e-9);
  // On both sides of each row, 6 cm beyond the bare strip's half.
  ASSERT_EQ(found["fringe"].size(), 4u * 6);
  for (const Eigen::Vector3d& p : found["fringe"]) {
    const double from_row = std::min(std::abs(p.y()), std::abs(p.y() - 2));
    EXPECT_NEAR(from_row, world_.ground.bare_strip / 2 + 0.06, 1e-9);
  }
  // Long grass keeps out of the aisles.
  for (const Eigen::Vector3d& p : found["grass"]) {
    const bool inside = p.x() > -kRowEnd && p.x() < 6 + kRowEnd && p.y() > -1 && p.y() < 3;
    EXPECT_FALSE(inside) << p.transpose();
  }
}

TEST_F(GroundCoverTest, NothingGrowsBeyondTheGround) {
  world_.ground_size = 8;  // around (3, 1)
  for (int i = 0; i < 2; ++i) {
    for (const Instance& instance : cover().instances) {
      const Eigen::Vector3d& p = instance.T_world_model.translation;
      EXPECT_LE(std::abs(p.x() - 3), 3 + 1e-9);
      EXPECT_LE(std::abs(p.y() - 1), 3 + 1e-9);
    }
    set_grass();
  }
}

TEST_F(GroundCoverTest, PatchesThinOutAndEndWithTheDistance) {
  const Scene scene = cover();
  for (const Model& model : scene.models) {
    ASSERT_EQ(model.levels.size(), 4u) << model.name;
    EXPECT_LT(triangle_count(model.levels[1]), triangle_count(model.levels[0]) / 2) << model.name;
    EXPECT_GT(triangle_count(model.levels[1]), 0) << model.name;
    // Then a few cards, of two triangles each, and in the end nothing.
    EXPECT_LE(triangle_count(model.levels[2]), 8) << model.name;
    EXPECT_GE(triangle_count(model.levels[2]), 4) << model.name;
    EXPECT_EQ(triangle_count(model.levels[3]), 0) << model.name;
    EXPECT_LT(model.levels[0].until, model.levels[1].until);
    EXPECT_LT(model.levels[1].until, model.levels[2].until);
    // Nothing is taller than the longest weeds, or digs into the ground by more than a pebble.
    EXPECT_LT(model.bounds.max().z(), 0.18f) << model.name;
    EXPECT_GT(model.bounds.min().z(), -0.03f) << model.name;
  }
}

TEST_F(GroundCoverTest, LiesOnTheGround) {
  world_.terrain.amplitude = 0.2;
  world_.terrain.slope_percent = 8;
  const Terrain terrain = lay_out(world_).terrain;
  for (const Instance& instance : cover().instances) {
    const Eigen::Vector3d& p = instance.T_world_model.translation;
    EXPECT_NEAR(p.z(), terrain.height(p.head<2>()), 1e-9);
  }
}

TEST_F(GroundCoverTest, ASeedIsOneCover) {
  const auto models = [](const Scene& scene) {
    std::vector<int> numbers;
    for (const Instance& instance : scene.instances) numbers.push_back(instance.model);
    return numbers;
  };
  EXPECT_EQ(models(cover()), models(cover()));
  EXPECT_NE(models(cover()), models(cover(2)));
}

}  // namespace
}  // namespace vinebench::sim
