// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/vineyard/occluders/occluders.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <set>

#include "sim/config_files.h"
#include "sim/rover/rover.h"
#include "sim/textures/textures.h"
#include "sim/vineyard/occluders/occluder_shape.h"
#include "sim/world/world_layout.h"

namespace vinebench::sim {
namespace {

using Shape = Occluder::Shape;

WorldConfig six_metre_row() {
  WorldConfig world;
  world.rows = {{{0, 0}, {6, 0}}};
  return world;
}

RoverConfig csl_rover() {
  return load_rover(std::filesystem::path(VINEBENCH_SOURCE_DIR) / "models/csl-rover/rover.yaml");
}

Scene scene_with(const WorldConfig& world) {
  Scene scene;
  add_occluders(scene, world, lay_out(world), 1);
  return scene;
}

/// Spread of an image's first channel, 0 to 255.
double spread(const Texture& texture) {
  cv::Mat red;
  cv::extractChannel(texture.rgba, red, 0);
  cv::Scalar mean, deviation;
  cv::meanStdDev(red, mean, deviation);
  return deviation[0];
}

TEST(CartonTest, APrintedOneHasAPrintOfItsSeed) {
  // Plain board varies by a few grey levels and its tape; print is dark.
  EXPECT_LT(spread(carton_texture(1)), 15);
  EXPECT_GT(spread(print_texture(1)), 40);
  EXPECT_EQ(cv::norm(print_texture(1).rgba, print_texture(1).rgba, cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(print_texture(1).rgba, print_texture(2).rgba, cv::NORM_INF), 100);
}

TEST(CartonTest, OnlyThePrintedOneCarriesThePrint) {
  WorldConfig world = six_metre_row();
  world.occluders.resize(2);
  world.occluders[1].printed = true;
  const Scene scene = scene_with(world);
  ASSERT_EQ(scene.models.size(), 2u);
  const auto texture_of = [&](std::size_t model) {
    const int material = scene.models[model].levels[0].primitives[0].material;
    const int texture = scene.materials[static_cast<std::size_t>(material)].texture;
    return scene.textures[static_cast<std::size_t>(texture)].name;
  };
  EXPECT_EQ(texture_of(0), "carton");
  EXPECT_EQ(texture_of(1), "print");
}

TEST(OccludersTest, APersonIsAsTallAsAskedAndStandsOnTheGround) {
  WorldConfig world = six_metre_row();
  world.terrain.slope_percent = 10;
  world.occluders = {{.shape = Shape::kPerson, .position = {5, 1}, .height = 1.6}};
  const Scene scene = scene_with(world);
  ASSERT_EQ(scene.instances.size(), 1u);
  const Instance& person = scene.instances[0];
  const Eigen::AlignedBox3f bounds = scene.models[0].bounds;
  // The hat's crown is the figure's top; soles are 0.5 cm above or below the ground.
  EXPECT_NEAR(bounds.max().z() * person.scale, 1.6, 0.02);
  EXPECT_NEAR(bounds.min().z(), 0, 0.015);
  EXPECT_NEAR(person.T_world_model.translation.z(), 0.2, 1e-9);  // 2 m uphill of the middle
}

TEST(OccludersTest, EveryShapeFillsItsSizeAndHasTheLabelOfItsClass) {
  for (const Shape shape :
       {Shape::kBox, Shape::kPerson, Shape::kCrate, Shape::kCylinder, Shape::kSheet}) {
    WorldConfig world = six_metre_row();
    world.occluders = {{.shape = shape, .kind = OccluderClass::kLeaf, .lift = 0.5}};
    const Scene scene = scene_with(world);
    const Eigen::Vector3d size = size_of(world.occluders[0]);
    const Instance& instance = scene.instances.at(0);
    const Eigen::AlignedBox3d bounds = scene.models[0].bounds.cast<double>();
    EXPECT_NEAR(bounds.sizes().z(), size.z(), 0.03) << static_cast<int>(shape);
    // A person's raised arm reaches an arm's length, 0.3 m, beyond the footprint that is stood on.
    const double beyond = shape == Shape::kPerson ? 0.3 : 0.05;
    EXPECT_LT((bounds.sizes() - size).maxCoeff(), beyond) << static_cast<int>(shape);
    // Its foot is 0.5 m above the ground, however its own origin lies.
    EXPECT_NEAR(instance.T_world_model.translation.z() + bounds.min().z(), 0.5, 0.015);
    for (const Material& material : scene.materials) {
      EXPECT_EQ(material.label, Label::kLooseLeaf);
    }
  }
}

TEST(OccludersTest, NumbersCountWithinEachListOfTheFile) {
  WorldConfig world = six_metre_row();
  world.occluders.resize(4);
  for (const std::size_t i : {0, 1}) world.occluders[i].list = Occluder::List::kBoxes;
  world.occluders[2].list = Occluder::List::kObstacles;
  const Scene scene = scene_with(world);
  EXPECT_EQ(scene.instances[1].id, 1);
  EXPECT_EQ(scene.instances[2].id, 0);
  EXPECT_EQ(scene.instances[3].id, 0);
}

TEST(OccludersTest, OneWithAPathMovesItsModelWithItsOrigin) {
  WorldConfig world = six_metre_row();
  world.occluders.resize(2);
  world.occluders[1].size = {0.4, 0.4, 0.6};
  world.occluders[1].path.emplace();
  world.occluders[1].path->waypoints = {{{2, 1}}, {{4, 1}}};
  const Scene scene = scene_with(world);
  ASSERT_EQ(scene.motions.size(), 1u);
  EXPECT_EQ(scene.motions[0].instance, 1);
  // The box's model has its origin in its middle, 0.3 m above the ground; it goes 1 m/s.
  const auto at = [&](double seconds) {
    return scene.motions[0].T_world_model(from_seconds(seconds)).translation;
  };
  EXPECT_LT((at(0) - Eigen::Vector3d(2, 1, 0.3)).norm(), 1e-9);
  EXPECT_LT((at(0) - scene.instances[1].T_world_model.translation).norm(), 1e-9);
  EXPECT_LT((at(1.5) - Eigen::Vector3d(3.5, 1, 0.3)).norm(), 1e-9);
}

TEST(OccluderShapeTest, ThePersonsBlocksEncloseTheFigure) {
  Occluder person;
  person.shape = Shape::kPerson;
  Eigen::AlignedBox3d box;
  for (const Block& block : shape_of(person).blocks(person)) {
    box.extend(block.centre - block.half).extend(block.centre + block.half);
  }
  EXPECT_NEAR(box.max().z(), 1.75, 0.02);
  EXPECT_NEAR(box.min().z(), 0, 1e-9);
  EXPECT_GT(box.sizes().y(), 0.45);
  EXPECT_LT(box.sizes().y(), 0.65);
}

TEST(OccludersTest, APersonAndACrateBlockTheRover) {
  for (const Shape shape : {Shape::kPerson, Shape::kCrate}) {
    WorldConfig world = six_metre_row();
    world.occluders = {{.shape = shape, .position = {1, 3}}};
    Rover rover(csl_rover(), world, {0, 3, 0}, 1);
    std::vector<ImuSample> imu;
    std::vector<WheelSample> wheels;
    rover.command({0.4, 0, 0});
    rover.advance_to(3 * kNanosecondsPerSecond, imu, wheels);
    // Free it would be at 1.2 m. Feet begin at 0.90 m, a crate at 0.70 m; the rover's nose is 0.25
    // m ahead of its middle, and it turns a little as it pushes.
    EXPECT_GT(rover.T_world_body().translation.x(), 0.35);
    EXPECT_LT(rover.T_world_body().translation.x(), 0.72);
  }
}

TEST(OccludersTest, AMovingBoxPushesTheRoverAlong) {
  WorldConfig world = six_metre_row();
  world.occluders.resize(1);
  world.occluders[0].size = {0.4, 0.8, 0.6};
  world.occluders[0].path.emplace();
  world.occluders[0].path->speed = 0.3;
  world.occluders[0].path->waypoints = {{{-1, 3}}, {{1, 3}}};
  Rover rover(csl_rover(), world, {0, 3, 0}, 1);
  std::vector<ImuSample> imu;
  std::vector<WheelSample> wheels;
  rover.command({0, 0, 0});
  rover.advance_to(kNanosecondsPerSecond, imu, wheels);
  // The box's face begins at -0.8 m and reaches the rover's tail, 0.25 m behind it, after 1.8 s.
  EXPECT_NEAR(rover.T_world_body().translation.x(), 0, 0.001);
  rover.advance_to(4 * kNanosecondsPerSecond, imu, wheels);
  // Then the face is at 0.4 m; contacts give way by a few centimetres, and it may roll ahead.
  EXPECT_GT(rover.T_world_body().translation.x(), 0.55);
  EXPECT_LT(rover.T_world_body().translation.x(), 0.8);
}

}  // namespace
}  // namespace vinebench::sim
