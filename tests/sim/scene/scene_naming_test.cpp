// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/scene/scene_naming.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/broken_files.h"

namespace vinebench::sim {
namespace {

/// A plant, a sign without triangles and a rover; the plant stands there twice.
Scene small_scene() {
  Scene scene;
  Asset plant = test::small_plant();
  plant.model.levels[0].primitives[0].vertices[0].part = 2;
  const int model = add_asset(scene, plant);
  scene.instances.push_back({model, Pose{}, 1, 40});
  scene.instances.push_back({model, {Eigen::Quaterniond::Identity(), {5, 0, 0}}, 2, 41});
  Asset rover = test::small_plant();
  rover.model.name = "rover";
  for (Material& material : rover.materials) material.label = Label::kRover;
  scene.rover_model = add_asset(scene, rover);
  return scene;
}

// A number is 256 times the instance's place, counted from 1, plus the part.
TEST(SceneNamingTest, NumbersNameInstancesAndParts) {
  const Scene scene = small_scene();
  const InstanceName second = instance_name(scene, 2 * 256 + 7);
  EXPECT_EQ(second.thing, Thing::kVine);
  EXPECT_EQ(second.index, 1);
  EXPECT_EQ(second.id, 41);
  EXPECT_EQ(second.part, 7);
  EXPECT_EQ(second.model, "plant");
}

TEST(SceneNamingTest, AModelThatSaysWhatItIsIsNotJudgedByItsMaterial) {
  Scene scene = small_scene();
  scene.models[0].thing = Thing::kOccluder;
  EXPECT_EQ(instance_name(scene, 256).thing, Thing::kOccluder);
  EXPECT_EQ(thing_of(Label::kBunch), Thing::kVine);
  EXPECT_EQ(thing_of(Label::kTarpaulin), Thing::kOccluder);
}

TEST(SceneNamingTest, TheRoverComesAfterTheInstances) {
  const InstanceName rover = instance_name(small_scene(), 3 * 256);
  EXPECT_EQ(rover.thing, Thing::kRover);
  EXPECT_EQ(rover.index, -1);
  EXPECT_EQ(rover.model, "rover");
}

TEST(SceneNamingTest, ZeroIsNothingAndOthersAreErrors) {
  EXPECT_EQ(instance_name(small_scene(), 0).thing, Thing::kNone);
  EXPECT_THAT(test::error_of([] { instance_name(small_scene(), 4 * 256); }),
              testing::HasSubstr("the scene has 2 instances"));
  EXPECT_THAT(test::error_of([] { instance_name(small_scene(), -1); }),
              testing::HasSubstr("instance number -1"));
}

TEST(SceneNamingTest, TheIndexKnowsTheScenesThingsAndPoints) {
  const Scene scene = small_scene();
  const SceneIndex index = index_of(scene);
  EXPECT_EQ(index.thing(256), Thing::kVine);
  EXPECT_EQ(index.thing(3 * 256), Thing::kRover);
  // One vertex of part 2: a bunch of both plants; the second is twice as large, 5 m along x.
  EXPECT_THAT(index.bunches(), testing::ElementsAre(256 + 2, 2 * 256 + 2));
  const Eigen::Vector3d p =
      scene.models[0].levels[0].primitives[0].vertices[0].position.cast<double>();
  ASSERT_EQ(index.points(2 * 256 + 2).size(), 1u);
  EXPECT_LT((index.points(2 * 256 + 2)[0] - (Eigen::Vector3d(5, 0, 0) + 2 * p)).norm(), 1e-6);
}

}  // namespace
}  // namespace vinebench::sim
