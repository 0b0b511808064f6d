// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "sim/plants/grapevine.h"
#include "sim/scene/scene_check.h"
#include "sim/world/world_layout.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

/// Two rows of ten vines on a slope; the plants are two meshes of one triangle each.
class SceneBuilderTest : public testing::Test {
 protected:
  SceneBuilderTest() {
    world_.ground_size = 20;
    world_.block = WorldConfig::Block{2, 10, 2, 30, {0, 0}};
    world_.terrain.slope_percent = 10;
    world_.vines.meshes = {folder_.write("a.obj", "v 0 0 0\nv 0.1 0 0\nv 0 0 1\nf 1 2 3\n"),
                           folder_.write("b.obj", "v 0 0 0\nv 0.1 0 0\nv 0 0 2\nf 1 2 3\n")};
  }
  Scene build(std::uint64_t seed = 1) const { return build_scene(world_, seed, folder_ / "cache"); }
  static std::string name_of(const Scene& scene, const Instance& instance) {
    return scene.models[static_cast<std::size_t>(instance.model)].name;
  }
  /// Headings of the plants, rounded to degrees of a circle.
  std::set<int> headings(const Scene& scene) const {
    std::set<int> found;
    for (std::size_t i = 0; i < 20; ++i) {
      const double yaw = yaw_of(scene.instances[i].T_world_model.rotation) * 180 / M_PI;
      found.insert((static_cast<int>(std::lround(yaw)) + 360) % 360);
    }
    return found;
  }

  test::TestFolder folder_;
  WorldConfig world_;
};

TEST_F(SceneBuilderTest, PlantsComeFirstInTheirPlacesOnTheGround) {
  const Scene scene = build();
  const WorldLayout layout = lay_out(world_);
  ASSERT_EQ(layout.vines.size(), 20u);
  std::set<std::string> models;
  for (std::size_t i = 0; i < 20; ++i) {
    const Instance& plant = scene.instances[i];
    const Eigen::Vector2d& foot = layout.vines[i].foot;
    EXPECT_EQ(plant.id, static_cast<int>(i));
    EXPECT_LT((plant.T_world_model.translation.head<2>() - foot).norm(), 1e-12);
    EXPECT_EQ(plant.T_world_model.translation.z(), layout.terrain.height(foot));
    EXPECT_GE(plant.scale, 1);
    EXPECT_LE(plant.scale, kLargestPlantScale);
    models.insert(name_of(scene, plant));
  }
  // Of 20 draws between two models none misses one, but for one seed of half a million.
  EXPECT_EQ(models, (std::set<std::string>{"a", "b"}));
  EXPECT_NO_THROW(check_scene(scene));
}

TEST_F(SceneBuilderTest, WoodLedToOneSidePointsTheSameWayAllAlong) {
  world_.vines.training = Training::kBilateralCordon;
  EXPECT_EQ(headings(build()), (std::set<int>{30, 210}));
  for (const Training training : {Training::kUnilateralCordon, Training::kSingleGuyot}) {
    world_.vines.training = training;
    EXPECT_EQ(headings(build()), std::set<int>{30});
  }
}

TEST_F(SceneBuilderTest, HasEveryPartOfTheWorld) {
  world_.occluders.resize(1);
  world_.occluders[0].position = {5, -2};
  world_.tags.resize(1);
  world_.tags[0].position = {1, -2, 0.5};
  const Scene scene = build();
  std::multiset<std::string> names;
  for (const Instance& instance : scene.instances) names.insert(name_of(scene, instance));
  for (const char* name : {"tag36h11-0", "carton", "apron", "hedge"}) {
    EXPECT_EQ(names.count(name), 1u) << name;
  }
  const WorldLayout layout = lay_out(world_);
  EXPECT_EQ(names.count("post") + names.count("end post"), layout.posts.size());
  EXPECT_FALSE(scene.wires.empty());
  EXPECT_TRUE(scene.motions.empty());
}

TEST_F(SceneBuilderTest, CarriesSeedLightAndWind) {
  world_.wind.speed = 3;
  const Scene low = [&] {
    world_.sun.elevation_deg = 10;
    return build(7);
  }();
  EXPECT_EQ(low.seed, 7u);
  EXPECT_EQ(low.wind.speed, 3);
  EXPECT_NEAR(low.light.towards_sun.z(), std::sin(10 * M_PI / 180), 1e-6);
}

}  // namespace
}  // namespace vinebench::sim
