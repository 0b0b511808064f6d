// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/rover/physics_world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "core/geometry/rig.h"
#include "core/util/error.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

const std::filesystem::path kModels =
    std::filesystem::path(VINEBENCH_SOURCE_DIR) / "models/csl-rover";

WorldConfig one_row() {
  WorldConfig world;
  world.rows = {{{0, 10}, {4, 10}}};
  return world;
}

Eigen::Vector3d vector_of(const mjtNum* numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

/// Points on the surface of a geom, in its own frame, dense enough to find its extent within 2 mm.
std::vector<Eigen::Vector3d> surface(int type, const Eigen::Vector3d& size) {
  std::vector<Eigen::Vector3d> points;
  constexpr int kSteps = 48;
  for (int i = 0; i <= kSteps / 2; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double polar = 2 * std::numbers::pi * i / kSteps;
      const double around = 2 * std::numbers::pi * j / kSteps;
      const Eigen::Vector3d unit(std::sin(polar) * std::cos(around),
                                 std::sin(polar) * std::sin(around), std::cos(polar));
      const Eigen::Vector2d ring = unit.head<2>().normalized() * size.x();
      switch (type) {
        case mjGEOM_ELLIPSOID:
          points.emplace_back(unit.cwiseProduct(size));
          break;
        case mjGEOM_BOX:
          points.emplace_back(unit.cwiseProduct(size) / unit.cwiseAbs().maxCoeff());
          break;
        default:  // cylinder, or a capsule with its caps made flat and full
          points.emplace_back(
              ring.x(), ring.y(),
              (size.y() + (type == mjGEOM_CAPSULE ? size.x() : 0)) * std::cos(polar));
      }
    }
  }
  return points;
}

/// Surface of the rover's visual geoms in its body frame.
std::vector<Eigen::Vector3d> rover_surface(PhysicsWorld& physics) {
  physics.refresh();
  std::vector<Eigen::Vector3d> points;
  const mjModel& model = physics.model();
  const int chassis = physics.find(mjOBJ_BODY, "chassis");
  for (int geom = 0; geom < model.ngeom; ++geom) {
    if (model.body_rootid[model.geom_bodyid[geom]] != chassis) continue;
    const Eigen::Matrix3d rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(
        &physics.state().geom_xmat[9 * geom]);
    for (const Eigen::Vector3d& point :
         surface(model.geom_type[geom], vector_of(&model.geom_size[3 * geom]))) {
      points.push_back(rotation * point + vector_of(&physics.state().geom_xpos[3 * geom]));
    }
  }
  return points;
}

TEST(PhysicsWorldTest, RoverFitsTheAisles) {
  PhysicsWorld physics(kModels / "rover.xml", one_row());
  double width = 0;
  double radius = 0;
  double top = 0;
  for (const Eigen::Vector3d& point : rover_surface(physics)) {
    width = std::max(width, 2 * std::abs(point.y()));
    radius = std::max(radius, point.head<2>().norm());
    if (point.z() > 0.30) {  // the mast
      EXPECT_LT(point.head<2>().cwiseAbs().maxCoeff(), 0.15) << point.transpose();
    }
    top = std::max(top, point.z());
  }
  // Rows 0.8 m apart, posts of 0.035 m radius: 0.73 m are free.
  EXPECT_LT(width, 0.56);
  EXPECT_LT(radius, 0.365);
  EXPECT_GT(top, 0.45);
}

TEST(PhysicsWorldTest, NoPartOfTheRoverIsInAImage) {
  PhysicsWorld physics(kModels / "rover.xml", one_row());
  const std::vector<Eigen::Vector3d> points = rover_surface(physics);
  ASSERT_GT(points.size(), 10000u);
  for (const RigCamera& camera : load_rig(kModels / "rig.yaml").cameras) {
    const Pose T_cam_body = camera.T_body_cam.inverse();
    for (const Eigen::Vector3d& point : points) {
      const Eigen::Vector3d p_cam = T_cam_body * point;
      if (p_cam.z() <= 0) continue;
      // 10 px off: the chassis tilts by 0.1 deg, about 1 px.
      ASSERT_FALSE(camera.model.contains(camera.model.project(p_cam), -10))
          << camera.name << " sees the rover at " << point.transpose();
    }
  }
}

TEST(PhysicsWorldTest, ObstaclesStandWhereTheWorldSays) {
  WorldConfig world = one_row();
  world.occluders.resize(2);  // duplicate names are allowed
  world.occluders[1].position = {2, 3};
  world.occluders[1].size = {0.6, 0.4, 0.3};
  world.occluders[1].yaw_deg = 90;
  PhysicsWorld physics(kModels / "rover.xml", world);
  physics.refresh();
  const int post = physics.find(mjOBJ_GEOM, "post 0");
  EXPECT_NEAR((vector_of(&physics.state().geom_xpos[3 * post]) -
               Eigen::Vector3d(0, 10, world.trellis.post_height / 2))
                  .norm(),
              0, 1e-9);
  const int box = physics.find(mjOBJ_GEOM, "carton 1");
  EXPECT_NEAR((vector_of(&physics.state().geom_xpos[3 * box]) - Eigen::Vector3d(2, 3, 0.15)).norm(),
              0, 1e-9);
  // Turned by 90 deg, its long side (x) lies along the world's y.
  EXPECT_NEAR(physics.state().geom_xmat[9 * box + 3], 1, 1e-9);
}

TEST(PhysicsWorldTest, LeavesNoTemporaryFile) {
  const auto files = [] {
    int count = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::temp_directory_path())) {
      count += entry.path().filename().string().starts_with("vinebench-") ? 1 : 0;
    }
    return count;
  };
  const test::TestFolder folder;
  const char* before = std::getenv("TMPDIR");
  const std::string restored = before ? before : "";
  setenv("TMPDIR", folder.path().c_str(), 1);
  PhysicsWorld(kModels / "rover.xml", one_row());
  EXPECT_THROW(PhysicsWorld("/nowhere.xml", one_row()), Error);
  EXPECT_EQ(files(), 0);
  before ? setenv("TMPDIR", restored.c_str(), 1) : unsetenv("TMPDIR");
}

TEST(PhysicsWorldTest, LoadsFromAFolderOfAnyName) {
  const test::TestFolder tests;
  const std::filesystem::path folder = tests / "rovers & <\"friends\">";
  std::filesystem::create_directories(folder);
  std::filesystem::copy_file(kModels / "rover.xml", folder / "rover.xml",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_NO_THROW(PhysicsWorld(folder / "rover.xml", one_row()));
}

TEST(PhysicsWorldTest, ReportsPhysicsThatFail) {
  PhysicsWorld physics(kModels / "rover.xml", one_row());
  physics.refresh();
  EXPECT_NO_THROW(physics.check());
  physics.state().qvel[0] = 1e30;
  physics.step();
  EXPECT_THAT([&] { physics.check(); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("the physics failed at")));
}

// A person walks 1 m/s from (1, 3) to the east.
TEST(MovingOccluderTest, IsWhereItsPathHasItAtThatTime) {
  WorldConfig world = one_row();
  world.occluders.resize(1);
  world.occluders[0].shape = Occluder::Shape::kPerson;
  world.occluders[0].path.emplace();
  world.occluders[0].path->waypoints = {{{1, 3}}, {{4, 3}}};
  PhysicsWorld physics(kModels / "rover.xml", world);
  physics.refresh();
  const int body = physics.find(mjOBJ_BODY, "person 0");
  const int head = physics.find(mjOBJ_GEOM, "person 0 block 3");
  const auto place_of = [](const mjtNum* places, int index) {
    return vector_of(places + 3 * index);
  };
  EXPECT_LT((place_of(physics.state().xpos, body) - Eigen::Vector3d(1, 3, 0)).norm(), 1e-9);
  physics.move_occluders(2 * kNanosecondsPerSecond);
  physics.refresh();
  EXPECT_LT((place_of(physics.state().xpos, body) - Eigen::Vector3d(3, 3, 0)).norm(), 1e-9);
  // The head's block is 0.02 m ahead of the feet and 1.6 m high.
  EXPECT_LT((place_of(physics.state().geom_xpos, head) - Eigen::Vector3d(3.02, 3, 1.6)).norm(),
            1e-9);
}

}  // namespace
}  // namespace vinebench::sim
