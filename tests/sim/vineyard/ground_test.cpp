// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/vineyard/ground.h"

#include <gtest/gtest.h>

#include "sim/assets/asset.h"
namespace vinebench::sim {
namespace {

/// Area of a primitive's shadow straight down, m^2; skirts have none.
double area_from_above(const Primitive& part) {
  double area = 0;
  for (std::size_t i = 0; i < part.indices.size(); i += 3) {
    const auto at = [&](std::size_t k) {
      return part.vertices.at(part.indices.at(i + k)).position.head<2>().cast<double>().eval();
    };
    const Eigen::Vector2d u = at(1) - at(0), v = at(2) - at(0);
    const double twice = u.x() * v.y() - u.y() * v.x();
    EXPECT_GT(twice, -1e-5);  // counter-clockwise from above
    area += twice / 2;
  }
  return area;
}

double area_from_above(const LevelOfDetail& level) {
  double area = 0;
  for (const Primitive& part : level.primitives) area += area_from_above(part);
  return area;
}

class GroundTest : public testing::Test {
 protected:
  using Aisles = GroundConfig::Aisles;

  static WorldConfig two_rows(Aisles aisles) {
    WorldConfig world;
    world.rows = {{{0, 0}, {6, 0}}, {{0, 2}, {6, 2}}};
    world.terrain.margin = 2;
    world.ground_size = 50;
    world.ground.aisles = aisles;
    return world;
  }
  static Scene ground(const WorldConfig& world) {
    Scene scene;
    add_ground(scene, world, lay_out(world), 1);
    return scene;
  }
  /// Made once: their textures take a while.
  static const Scene& soil() {
    static const Scene kScene = ground(two_rows(Aisles::kSoil));
    return kScene;
  }
  static const Scene& grass() {
    static const Scene kScene = ground(two_rows(Aisles::kGrass));
    return kScene;
  }
  static Terrain terrain() { return lay_out(two_rows(Aisles::kSoil)).terrain; }
  static const Model& model_of(const Scene& scene, const Instance& instance) {
    return scene.models.at(static_cast<std::size_t>(instance.model));
  }
};

TEST_F(GroundTest, EveryLevelOfTheTilesCoversTheGrid) {
  const auto tiles = static_cast<std::size_t>(terrain().tiles_x() * terrain().tiles_y());
  for (const Scene* scene : {&soil(), &grass()}) {
    ASSERT_EQ(scene->instances.size(), 1 + tiles);  // the apron is the first
    const std::size_t levels = model_of(*scene, scene->instances.back()).levels.size();
    EXPECT_EQ(levels, 3u);  // even ground
    for (std::size_t level = 0; level < levels; ++level) {
      double area = 0;
      for (std::size_t i = 1; i <= tiles; ++i) {
        area += area_from_above(model_of(*scene, scene->instances[i]).levels.at(level));
      }
      EXPECT_NEAR(area, terrain().box().volume(), 1e-3) << level;
    }
  }
}

TEST_F(GroundTest, LevelsGetCoarser) {
  const std::vector<LevelOfDetail>& levels = model_of(soil(), soil().instances.back()).levels;
  for (std::size_t i = 1; i < levels.size(); ++i) {
    EXPECT_GT(levels[i].until, levels[i - 1].until);
    EXPECT_LT(triangle_count(levels[i]), triangle_count(levels[i - 1]) / 2);
  }
  EXPECT_EQ(levels.back().until, 1e9);
}

// The finest level is for the light map alone.
TEST_F(GroundTest, EvenGroundIsDrawnInLargeTriangles) {
  const std::vector<LevelOfDetail>& levels = model_of(soil(), soil().instances.back()).levels;
  EXPECT_EQ(levels.front().until, 0);
  EXPECT_GT(triangle_count(levels[0]), 10 * triangle_count(levels[1]));
}

TEST_F(GroundTest, TheApronIsTheRestOfTheSquare) {
  const Model& apron = model_of(soil(), soil().instances.front());
  EXPECT_EQ(apron.name, "apron");
  EXPECT_NEAR(area_from_above(apron.levels.at(0)), 50 * 50 - terrain().box().volume(), 1e-2);
  const Eigen::Vector2d middle = terrain().frame().to_world(terrain().box().center());
  const Pose& T = soil().instances.front().T_world_model;
  const Eigen::Vector3d low = T * apron.bounds.min().cast<double>();
  EXPECT_NEAR(low.x(), middle.x() - 25, 1e-4);
  EXPECT_NEAR(low.y(), middle.y() - 25, 1e-4);
}

TEST_F(GroundTest, TilesStandWhereTheirNodesAre) {
  WorldConfig world;
  world.block = WorldConfig::Block{3, 9, 2, 30, {1, -2}};
  const Terrain grid = lay_out(world).terrain;
  const Scene scene = ground(world);
  for (int ty = 0; ty < grid.tiles_y(); ++ty) {
    for (int tx = 0; tx < grid.tiles_x(); ++tx) {
      const auto index = static_cast<std::size_t>(1 + ty * grid.tiles_x() + tx);
      const Instance& tile = scene.instances.at(index);
      EXPECT_EQ(tile.id, static_cast<int>(index) - 1);
      // The last node of a tile is the first of the next one.
      const Eigen::Vector3d far =
          tile.T_world_model * model_of(scene, tile).bounds.max().cast<double>();
      const Eigen::Vector2d expected =
          grid.frame().to_world(grid.node((tx + 1) * grid.cells_x(), (ty + 1) * grid.cells_y()));
      EXPECT_LT((far.head<2>() - expected).norm(), 1e-4) << tx << " " << ty;
    }
  }
}

TEST_F(GroundTest, SoilIsOneMaterialGrassHasItsAisles) {
  ASSERT_EQ(soil().materials.size(), 1u);
  EXPECT_EQ(soil().materials[0].label, Label::kGround);
  EXPECT_TRUE(soil().materials[0].terrain);
  const std::vector<Material>& materials = grass().materials;
  ASSERT_EQ(materials.size(), 2u);
  EXPECT_EQ(materials[0].label, Label::kGrass);
  EXPECT_EQ(materials[1].label, Label::kGround);
  EXPECT_TRUE(materials[0].terrain && materials[1].terrain);
  // Aisles reach from half a spacing before the first row to half a spacing behind the last one:
  // 2 * 2 m, and kRowEnd beyond the 6 m of their rows' ends.
  double aisles = 0;
  for (const Instance& instance : grass().instances) {
    for (const Primitive& part : model_of(grass(), instance).levels.at(0).primitives) {
      if (part.material == 1) aisles += area_from_above(part);
    }
  }
  EXPECT_NEAR(aisles, 4 * (6 + 2 * kRowEnd), 0.01);
}

TEST_F(GroundTest, TheCanopyShadesItsRow) {
  double under = 0, open = 0;
  int rows = 0, aisles = 0;
  for (std::size_t i = 1; i < soil().instances.size(); ++i) {
    const Instance& tile = soil().instances[i];
    for (const Primitive& part : model_of(soil(), tile).levels[0].primitives) {
      for (const Vertex& v : part.vertices) {
        const Eigen::Vector3d p = tile.T_world_model * v.position.cast<double>();
        if (p.x() < 1 || p.x() > 5) continue;
        if (std::abs(p.y()) < 0.01) under += double(v.occlusion), ++rows;
        if (std::abs(p.y() - 1) < 0.01) open += double(v.occlusion), ++aisles;
      }
    }
  }
  ASSERT_GT(rows, 0);
  ASSERT_GT(aisles, 0);
  // 0.35 less at the row itself, about a random shade of 0.05 on average.
  EXPECT_NEAR(under / rows, 0.95 - 0.35 - 0.05, 0.02);
  EXPECT_NEAR(open / aisles, 0.95 - 0.05, 0.02);
}

}  // namespace
}  // namespace vinebench::sim
