// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/draw_list.h"

#include <optional>

#include "tests/support/gl_fixture.h"
#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

/// Panels before a camera at the origin that looks along +y; its focal length is that for which
/// levels' distances are given.
class DrawListTest : public test::GlTest {
 protected:
  DrawListTest() {
    const int material = test::add_material(scene_, Label::kBox, Eigen::Vector3f::Ones());
    panel_ = test::add_model(scene_, test::panel(material, 1, 1));
  }
  DrawList list(double lod_scale = 1) const {
    const GpuScene gpu(gl_, scene_);
    const std::vector<Mover> movers = gpu.movers(0, T_world_rover_);
    return make_draw_list(gpu, camera_, T_world_cam_, lod_scale, {movers, nullptr});
  }
  /// The level of the only instance; -1 where it is not drawn.
  int level(double lod_scale = 1) const {
    const DrawList drawn = list(lod_scale);
    return drawn.batches.empty() ? -1 : drawn.batches.at(0).level;
  }

  Scene scene_;
  int panel_ = 0;
  PinholeCamera camera_{1100, 1100, kLevelFocalLength, kLevelFocalLength, 549.5, 549.5, {}};
  Pose T_world_cam_ = test::look_at({0, 0, 0}, {0, 1, 0});
  std::optional<Pose> T_world_rover_;
};

TEST_F(DrawListTest, HasWhatIsInViewWithItsNumberAndPlace) {
  test::add_instance(scene_, panel_, {0, -5, 0});   // behind
  test::add_instance(scene_, panel_, {0.5, 5, 1});  // in view
  test::add_instance(scene_, panel_, {9, 5, 0});    // beside
  const DrawList drawn = list();
  ASSERT_EQ(drawn.rows.size(), 1u);
  EXPECT_EQ(drawn.rows[0].number, 2u);
  // The camera sees it 0.5 m to the right, 1 m up (its y is down), 5 m ahead.
  const Eigen::Vector3f at = drawn.rows[0].matrix.col(3);
  EXPECT_LT((at - Eigen::Vector3f(0.5f, -1, 5)).norm(), 1e-6f);
  ASSERT_EQ(drawn.batches.size(), 1u);
  EXPECT_EQ(drawn.batches[0].model, panel_);
  EXPECT_EQ(drawn.batches[0].count, 1u);
  EXPECT_FALSE(drawn.batches[0].shaded);
}

TEST_F(DrawListTest, TheLevelIsThatOfTheDistanceTheLensAndTheScale) {
  scene_.models[0].levels[0].until = 4;
  scene_.models[0].levels.push_back({10, scene_.models[0].levels[0].primitives});
  test::add_instance(scene_, panel_, {0, 3.9, 0});
  EXPECT_EQ(level(), 0);
  scene_.instances[0].T_world_model.translation.y() = 4.1;
  EXPECT_EQ(level(), 1);
  EXPECT_EQ(level(1.1), 0);  // levels reach 1.1 times as far
  camera_.fx = camera_.fy = 2 * kLevelFocalLength;
  EXPECT_EQ(level(), 0);  // seen as from half the distance
  camera_.fx = camera_.fy = kLevelFocalLength / 2;
  EXPECT_EQ(level(), 1);  // as from 8.2 m
  scene_.instances[0].T_world_model.translation.y() = 5.1;
  EXPECT_EQ(level(), -1);  // beyond its last level
}

TEST_F(DrawListTest, TheDistanceIsThatOfTheNearestPoint) {
  // A panel of 1 m seen edge on begins half a metre before its middle.
  scene_.models[0].levels[0].until = 4;
  test::add_instance(scene_, panel_, {0, 4.4, 0});
  EXPECT_EQ(level(), -1);
  scene_.instances[0].T_world_model.rotation = exp_so3({0, 0, 1.5707963});
  EXPECT_EQ(level(), 0);
  scene_.instances[0].T_world_model.translation.y() = 4.6;
  EXPECT_EQ(level(), -1);
  scene_.instances[0].scale = 1.5;  // 0.75 m before its middle
  EXPECT_EQ(level(), 0);
}

TEST_F(DrawListTest, NearOnesComeFirstAndThoseOfOneDistanceTogether) {
  test::add_instance(scene_, panel_, {0, 50, 0});
  test::add_instance(scene_, panel_, {0, 5, 0});
  test::add_instance(scene_, panel_, {1, 50, 0});
  test::add_instance(scene_, panel_, {0, 1, 0});
  const DrawList drawn = list();
  std::vector<std::uint32_t> numbers;
  for (const InstanceRow& row : drawn.rows) numbers.push_back(row.number);
  EXPECT_EQ(numbers, (std::vector<std::uint32_t>{4, 2, 1, 3}));
  ASSERT_EQ(drawn.batches.size(), 3u);
  EXPECT_EQ(drawn.batches[2].first, 2u);
  EXPECT_EQ(drawn.batches[2].count, 2u);
}

TEST_F(DrawListTest, InstancesOfABatchAreNearToFar) {
  test::add_instance(scene_, panel_, {0, 50.2, 0});
  test::add_instance(scene_, panel_, {1, 50.1, 0});
  const DrawList drawn = list();
  ASSERT_EQ(drawn.batches.size(), 1u);
  EXPECT_EQ(drawn.rows[0].number, 2u);
}

// The bounds of walls all around contain the camera, which is 12 m away from them.
TEST_F(DrawListTest, WallsAroundTheCameraAreAsFarAsTheyStand) {
  Primitive walls = test::panel(0, 1, 1);
  const std::size_t corners = walls.vertices.size();
  const std::vector<std::uint32_t> indices = walls.indices;
  for (const std::uint32_t i : indices) {
    walls.indices.push_back(i + static_cast<std::uint32_t>(corners));
  }
  for (std::size_t i = 0; i < corners; ++i) {
    walls.vertices.push_back(walls.vertices[i]);
    walls.vertices[i].position.y() += 12;
    walls.vertices.back().position.y() -= 12;
  }
  test::add_instance(scene_, test::add_model(scene_, walls), {0, 0, 0});
  test::add_instance(scene_, panel_, {0, 5, 0});
  test::add_instance(scene_, panel_, {0, 40, 0});
  const DrawList drawn = list();
  ASSERT_EQ(drawn.rows.size(), 3u);
  EXPECT_EQ(drawn.rows[0].number, 2u);
  EXPECT_EQ(drawn.rows[1].number, 1u);
  EXPECT_EQ(drawn.rows[2].number, 3u);
}

TEST_F(DrawListTest, TheRoverIsOneMoreInstanceWhereItStands) {
  test::add_instance(scene_, panel_, {0, 5, 0});
  scene_.rover_model = panel_;
  EXPECT_EQ(list().rows.size(), 1u);  // it is not there
  T_world_rover_ = Pose{Eigen::Quaterniond::Identity(), {0, 2, 0}};
  const DrawList drawn = list();
  ASSERT_EQ(drawn.rows.size(), 2u);
  EXPECT_EQ(drawn.rows[0].number, 2u);
  EXPECT_NEAR(drawn.rows[0].matrix(2, 3), 2, 1e-6);
  T_world_rover_ = Pose{Eigen::Quaterniond::Identity(), {0, -3, 0}};
  EXPECT_EQ(list().rows.size(), 1u);  // behind the camera
}

}  // namespace
}  // namespace vinebench::sim
