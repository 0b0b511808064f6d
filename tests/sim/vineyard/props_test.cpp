// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/vineyard/props.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "sim/config_files.h"
#include "sim/rover/physics_world.h"
#include "sim/rover/rover.h"
#include "sim/textures/textures.h"
#include "sim/vineyard/obstacles.h"
#include "sim/vineyard/trellis.h"

namespace vinebench::sim {
namespace {

const std::filesystem::path kModels =
    std::filesystem::path(VINEBENCH_SOURCE_DIR) / "models/csl-rover";

WorldConfig one_row() {
  WorldConfig world;
  world.rows = {{{0, 0}, {6, 0}}};
  return world;
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
  WorldConfig world = one_row();
  world.boxes.resize(2);
  world.boxes[1].printed = true;
  Scene scene;
  add_boxes(scene, world, 1);
  ASSERT_EQ(scene.models.size(), 2u);
  const auto texture_of = [&](std::size_t model) {
    const int material = scene.models[model].levels[0].primitives[0].material;
    const int texture = scene.materials[static_cast<std::size_t>(material)].texture;
    return scene.textures[static_cast<std::size_t>(texture)].name;
  };
  EXPECT_EQ(texture_of(0), "carton");
  EXPECT_EQ(texture_of(1), "print");
}

TEST(ObstacleTest, APersonIsAsTallAsAskedAndStandsOnTheGround) {
  WorldConfig world = one_row();
  world.terrain.slope_percent = 10;
  world.obstacles.resize(1);
  world.obstacles[0].position = {5, 1};
  world.obstacles[0].height = 1.6;
  const Terrain terrain(world);
  Scene scene;
  add_obstacles(scene, world, terrain, 1);
  ASSERT_EQ(scene.instances.size(), 1u);
  const Instance& person = scene.instances[0];
  const Eigen::AlignedBox3f bounds = scene.models[0].bounds;
  // The hat is the person's highest point; soles are within 0.5 cm of the ground.
  EXPECT_NEAR(bounds.max().z() * person.scale, 1.6, 0.02);
  EXPECT_NEAR(bounds.min().z(), 0, 0.015);
  EXPECT_NEAR(person.T_world_model.translation.z(), 0.2, 1e-9);  // 2 m uphill of the middle
  for (const Material& material : scene.materials) EXPECT_EQ(material.label, Label::kPerson);
}

TEST(ObstacleTest, CollidersEncloseTheFigure) {
  WorldConfig::Obstacle person;
  Eigen::AlignedBox3d box;
  for (const Block& block : obstacle_blocks(person)) {
    box.extend(block.centre - block.half).extend(block.centre + block.half);
  }
  EXPECT_NEAR(box.max().z(), 1.75, 0.02);
  EXPECT_NEAR(box.min().z(), 0, 1e-9);
  EXPECT_GT(box.sizes().y(), 0.45);
  EXPECT_LT(box.sizes().y(), 0.65);
}

TEST(ObstacleTest, APersonAndACrateAreInTheWay) {
  for (const auto kind :
       {WorldConfig::Obstacle::Kind::kPerson, WorldConfig::Obstacle::Kind::kCrate}) {
    WorldConfig world = one_row();
    world.obstacles.resize(1);
    world.obstacles[0].kind = kind;
    world.obstacles[0].position = {1, 3};
    const auto config = load_rover(kModels / "rover.yaml");
    Rover rover(config, world, {0, 3, 0}, 1);
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

TEST(TrellisTest, BracesHoldTheEndPostsFromTheirSide) {
  WorldConfig world = one_row();
  world.trellis.end_brace = WorldConfig::Trellis::Brace::kAnchor;
  world.trellis.end_lean_deg = 15;
  const Terrain terrain(world);
  const std::vector<Brace> anchors = trellis_braces(world, terrain);
  ASSERT_EQ(anchors.size(), 2u);
  EXPECT_LT(anchors[0].foot.x(), anchors[0].head.x());
  EXPECT_LT(anchors[0].head.x(), 0);
  EXPECT_GT(anchors[1].foot.x(), anchors[1].head.x());
  EXPECT_EQ(anchors[0].foot.z(), 0);
  world.trellis.end_brace = WorldConfig::Trellis::Brace::kStrut;
  const std::vector<Brace> struts = trellis_braces(world, terrain);
  EXPECT_GT(struts[0].foot.x(), 0.5);
  EXPECT_LT(struts[1].foot.x(), 5.5);
  world.trellis.end_brace = WorldConfig::Trellis::Brace::kNone;
  EXPECT_TRUE(trellis_braces(world, terrain).empty());
}

TEST(TrellisTest, TheDripLineHangsBetweenItsClips) {
  WorldConfig world = one_row();
  world.trellis.drip_line = 0.45;
  world.trellis.drip_sag = 0.03;
  Scene scene;
  add_trellis(scene, world, Terrain(world), 1);
  double low = 1, high = 0, length = 0;
  for (const Wire& wire : scene.wires) {
    if (wire.radius < 0.005f) continue;  // a steel wire
    EXPECT_NEAR(wire.radius, 0.008, 1e-6);
    low = std::min({low, static_cast<double>(wire.from.z()), static_cast<double>(wire.to.z())});
    high = std::max(high, static_cast<double>(wire.from.z()));
    length += std::abs(wire.to.x() - wire.from.x());
  }
  EXPECT_NEAR(high, 0.45, 1e-6);
  EXPECT_NEAR(low, 0.42, 1e-6);
  EXPECT_NEAR(length, 6, 1e-5);
}

TEST(TrellisTest, PostsAndBracesStandInTheRoversWayToo) {
  WorldConfig world = one_row();
  world.trellis.end_lean_deg = 15;
  world.trellis.end_brace = WorldConfig::Trellis::Brace::kAnchor;
  PhysicsWorld physics(kModels / "rover.xml", world);
  physics.refresh();
  const int post = physics.find(mjOBJ_GEOM, "post 0");
  // Its middle is at half its height and leans out.
  EXPECT_NEAR(physics.state().geom_xpos[3 * post], -0.8 * std::tan(15 * 3.14159265358979 / 180),
              1e-9);
  EXPECT_NO_THROW(physics.find(mjOBJ_GEOM, "brace 1"));
}

}  // namespace
}  // namespace vinebench::sim
