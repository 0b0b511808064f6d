// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world/terrain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "core/util/error.h"
#include "sim/config_files.h"
#include "sim/rover/physics_world.h"
#include "sim/rover/rover.h"
#include "sim/vineyard/ground.h"
#include "sim/world/world.h"
#include "sim/world/world_layout.h"

namespace vinebench::sim {
namespace {

const std::filesystem::path kSource = VINEBENCH_SOURCE_DIR;

/// Three rotated rows on bumps, ruts and a slope.
WorldConfig bumpy() {
  WorldConfig world;
  world.ground_size = 40;
  world.block = WorldConfig::Block{3, 9, 2, 30, {1, -2}};
  world.terrain.amplitude = 0.05;
  world.terrain.wavelength = 2;
  world.terrain.rut_depth = 0.02;
  world.terrain.slope_percent = 4;
  world.terrain.slope_heading_deg = 70;
  world.ground.aisles = WorldConfig::Ground::Aisles::kGrass;
  return world;
}

/// Points all over the grid, away from its rim and its lines.
std::vector<Eigen::Vector2d> places(const Terrain& terrain, int count) {
  const RandomStream random(7, "places");
  const Eigen::AlignedBox2d box = terrain.box();
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d share(random.uniform(2 * i, 0.01, 0.99),
                                random.uniform(2 * i + 1, 0.01, 0.99));
    points.push_back(terrain.frame().to_world(box.min() + share.cwiseProduct(box.sizes())));
  }
  return points;
}

/// Height of the drawn mesh's finest level under a point; NaN if there is none.
double drawn_height(const Scene& scene, const Eigen::Vector2d& p) {
  for (const Instance& tile : scene.instances) {
    const Model& model = scene.models[static_cast<std::size_t>(tile.model)];
    const Eigen::Vector3d local = tile.T_world_model.inverse() * Eigen::Vector3d(p.x(), p.y(), 0);
    if (model.name != "ground" || local.x() < model.bounds.min().x() ||
        local.y() < model.bounds.min().y() || local.x() > model.bounds.max().x() ||
        local.y() > model.bounds.max().y()) {
      continue;
    }
    for (const Primitive& part : model.levels[0].primitives) {
      for (std::size_t i = 0; i < part.indices.size(); i += 3) {
        const auto corner = [&](std::size_t k) {
          return part.vertices[part.indices[i + k]].position.cast<double>().eval();
        };
        Eigen::Matrix3d sides;
        sides << corner(0), corner(1), corner(2);
        sides.row(2).setOnes();
        if (std::abs(sides.determinant()) < 1e-9) continue;  // a skirt is vertical
        const Eigen::Vector3d weights = sides.inverse() * Eigen::Vector3d(local.x(), local.y(), 1);
        if (weights.minCoeff() < 0) continue;
        return weights.x() * corner(0).z() + weights.y() * corner(1).z() +
               weights.z() * corner(2).z();
      }
    }
  }
  return std::nan("");
}

/// MuJoCo 3 takes one argument more, for the surface's normal.
template <class Ray, class... Arguments>
double ray_to(Ray ray, Arguments... arguments) {
  if constexpr (std::is_invocable_v<Ray, Arguments...>) {
    return ray(arguments...);
  } else {
    return ray(arguments..., nullptr);
  }
}

TEST(TerrainTest, IsOneSurfaceInPhysicsAndImage) {
  const WorldConfig world = bumpy();
  const Terrain terrain = lay_out(world).terrain;
  PhysicsWorld physics(kSource / "models/csl-rover/rover.xml", world);
  physics.refresh();
  Scene scene;
  add_ground(scene, world, lay_out(world), 1);
  const int ground = physics.find(mjOBJ_GEOM, "ground");
  for (const Eigen::Vector2d& p : places(terrain, 300)) {
    const mjtNum from[3]{p.x(), p.y(), 5};
    const mjtNum down[3]{0, 0, -1};
    const double distance =
        ray_to(mj_rayHfield, &physics.model(), &physics.state(), ground, from, down);
    ASSERT_GT(distance, 0) << p.transpose();
    // Elevations are floats, relative to a range of about 1 m: 1e-6 m would suffice; the
    // requirement is 1 mm.
    EXPECT_NEAR(5 - distance, terrain.height(p), 1e-5) << p.transpose();
    EXPECT_NEAR(drawn_height(scene, p), terrain.height(p), 1e-5) << p.transpose();
  }
}

TEST(TerrainTest, HasTheBumpsAskedForOnItsSlope) {
  WorldConfig world = bumpy();
  world.terrain.rut_depth = 0;
  const Terrain terrain = lay_out(world).terrain;
  const double heading = world.terrain.slope_heading_deg * 3.14159265358979 / 180;
  const Eigen::Vector2d uphill(std::cos(heading), std::sin(heading));
  double low = 0, high = 0;
  for (const Eigen::Vector2d& p : places(terrain, 2000)) {
    const double bump = terrain.height(p) - 0.04 * uphill.dot(p - terrain.frame().middle());
    low = std::min(low, bump);
    high = std::max(high, bump);
  }
  // The largest bumps reach the amplitude at most; of some hundreds one comes near it.
  EXPECT_LE(high, 0.05);
  EXPECT_GE(low, -0.05);
  EXPECT_GT(high, 0.025);
  EXPECT_LT(low, -0.025);
}

TEST(TerrainTest, WheelTracksAreLowerThanTheMiddleOfTheAisle) {
  WorldConfig world = bumpy();
  world.terrain.amplitude = 0;
  world.terrain.slope_percent = 0;
  const Terrain terrain = lay_out(world).terrain;
  const RowFrame frame = terrain.frame();
  // Rows lie at y = 0, 2 and 4 m of the frame; tracks 1.25 / 2 m either side of y = 1 and 3 m.
  const double half = world.ground.track_gauge / 2;
  for (const double aisle : {1.0, 3.0}) {
    EXPECT_NEAR(terrain.height(frame.to_world({4, aisle - half})), -0.02, 0.003);
    EXPECT_NEAR(terrain.height(frame.to_world({4, aisle + half})), -0.02, 0.003);
    EXPECT_NEAR(terrain.height(frame.to_world({4, aisle})), 0, 0.001);
  }
}

TEST(TerrainTest, GoesOnBeyondItsGridAsItsSlopeAlone) {
  const WorldConfig world = bumpy();
  const Terrain terrain = lay_out(world).terrain;
  const Eigen::Vector2d far = terrain.frame().middle() + Eigen::Vector2d(500, 0);
  EXPECT_NEAR(terrain.height(far), 0.04 * 500 * std::cos(70 * 3.14159265358979 / 180), 1e-9);
}

TEST(TerrainTest, EvenGroundIsAPlane) {
  WorldConfig world;
  world.rows = {{{0, 0}, {4, 0}}};
  const WorldLayout layout = lay_out(world);
  EXPECT_TRUE(layout.terrain.flat());
  EXPECT_EQ(layout.terrain.height({1.234, 0.7}), 0);
  EXPECT_THAT(world_mjcf(world, layout, "rover.xml"), testing::HasSubstr("type=\"plane\""));
}

TEST(TerrainTest, SameSeedSameGround) {
  WorldConfig world = bumpy();
  const Terrain one = lay_out(world).terrain, same = lay_out(world).terrain;
  world.terrain.seed = 2;
  const Terrain other = lay_out(world).terrain;
  EXPECT_EQ(one.node_height(40, 50), same.node_height(40, 50));
  EXPECT_NE(one.node_height(40, 50), other.node_height(40, 50));
}

WorldConfig typical() {
  return load_world(kSource / "worlds/typical-vineyard.yaml");
}

TEST(TerrainTest, TheRoverDrivesStraightOverIt) {
  const WorldConfig world = typical();
  const Terrain terrain = lay_out(world).terrain;
  const RoverConfig config = load_rover(kSource / "models/csl-rover/rover.yaml");
  Rover rover(config, world, {5, 1.25, 0}, 1);
  std::vector<ImuSample> imu;
  std::vector<WheelSample> wheels;
  rover.command({0.5, 0, 0});
  for (int i = 1; i <= 50; ++i) {
    rover.advance_to(i * kNanosecondsPerSecond / 5, imu, wheels);  // throws on lost contacts
    const Pose body = rover.T_world_body();
    double ground = 0;  // m, mean below the wheels
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) {
        const Eigen::Vector3d foot =
            body * Eigen::Vector3d(x * config.half_wheelbase, y * config.half_track, 0);
        ground += terrain.height(foot.head<2>()) / 4;
      }
    }
    EXPECT_NEAR(body.translation.z(), ground, 0.02);
    EXPECT_GT((body.rotation * Eigen::Vector3d::UnitZ()).z(), std::cos(0.15));
  }
  // Bumps and slip shorten 10 s at 0.5 m/s a little; without steering it may drift sideways.
  const Eigen::Vector3d end = rover.T_world_body().translation;
  EXPECT_NEAR(end.x(), 10, 0.25);
  EXPECT_NEAR(end.y(), 1.25, 0.40);
}

TEST(TerrainTest, TheRoverStartsAtRestOnIt) {
  const WorldConfig world = typical();
  const RoverConfig config = load_rover(kSource / "models/csl-rover/rover.yaml");
  Rover rover(config, world, {12, 3.75, 1.0}, 1);
  const Pose start = rover.T_world_body();
  EXPECT_NEAR(start.translation.x(), 12, 1e-12);
  std::vector<ImuSample> imu;
  std::vector<WheelSample> wheels;
  rover.advance_to(kNanosecondsPerSecond, imu, wheels);
  EXPECT_LT((rover.T_world_body().translation - start.translation).norm(), 0.001);
  for (const ImuSample& sample : imu) EXPECT_NEAR(sample.specific_force.norm(), 9.81, 0.05);
}

TEST(TerrainTest, WhereTheGroundEndsTheRoverSaysSo) {
  const RoverConfig config = load_rover(kSource / "models/csl-rover/rover.yaml");
  EXPECT_THAT(
      [&] {
        Rover(config, bumpy(), {200, 0, 0}, 1);
      },
      testing::ThrowsMessage<Error>(testing::HasSubstr("left the uneven ground")));
}

}  // namespace
}  // namespace vinebench::sim
