// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "sim/rover/physics_world.h"
#include "sim/world/world.h"
#include "sim/world/world_layout.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

/// A hundred places, a third of them empty; the plants are a mesh of one triangle.
WorldConfig gappy(const test::TestFolder& folder) {
  WorldConfig world;
  world.block = WorldConfig::Block{};
  world.block->rows = 4;
  world.block->length = 25;
  world.vines.missing = 0.3;
  world.vines.young = 0.2;
  world.vines.meshes = {folder.write("vine.obj", "v 0 0 0\nv 0.1 0 0\nv 0 0 1\nf 1 2 3\n")};
  return world;
}

/// Positions with a solid trunk.
std::set<int> trunks(const WorldConfig& world, std::uint64_t seed) {
  const WorldLayout layout = lay_out(world);
  const std::string mjcf = world_mjcf(world, layout, "rover.xml", seed);
  std::set<int> places;
  for (int i = 0; i < static_cast<int>(layout.vines.size()); ++i) {
    if (mjcf.find(fmt::format("\"trunk {}\"", i)) != std::string::npos) places.insert(i);
  }
  return places;
}

/// Positions with a visible plant: instances of the mesh.
std::set<int> plants(const WorldConfig& world, std::uint64_t seed, const test::TestFolder& folder) {
  const Scene scene = build_scene(world, seed, folder / "cache");
  std::set<int> places;
  for (const Instance& instance : scene.instances) {
    if (scene.models[static_cast<std::size_t>(instance.model)].name == "vine") {
      places.insert(instance.id);
    }
  }
  return places;
}

TEST(MissingVinesTest, AGapIsOneForTheRoverToo) {
  const test::TestFolder folder;
  const WorldConfig world = gappy(folder);
  for (const std::uint64_t seed : {1, 2}) {
    const std::set<int> seen = plants(world, seed, folder);
    EXPECT_EQ(trunks(world, seed), seen);
    // 100 draws of 0.7: mean 70, deviation 4.6; within four of them.
    EXPECT_NEAR(static_cast<double>(seen.size()), 70, 19);
  }
  EXPECT_NE(trunks(world, 1), trunks(world, 2));
}

TEST(MissingVinesTest, SharesAreThoseOfTheWorld) {
  WorldConfig world;
  world.vines.missing = 0.3;
  world.vines.young = 0.2;
  std::map<VineKind, int> count;
  for (std::size_t i = 0; i < 10'000; ++i) ++count[vine_at(world, 5, i)];
  // Deviations of 10 000 draws: 46, 40 and 50; within four of them.
  EXPECT_NEAR(count[VineKind::kNone], 3000, 184);
  EXPECT_NEAR(count[VineKind::kYoung], 2000, 160);
  EXPECT_NEAR(count[VineKind::kGrown], 5000, 200);
  world.vines.missing = 0;
  world.vines.young = 0;
  for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(vine_at(world, 5, i), VineKind::kGrown);
}

}  // namespace
}  // namespace vinebench::sim
