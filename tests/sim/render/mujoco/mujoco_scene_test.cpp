// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/mujoco/mujoco_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/test_scene.h"
#include "tests/support/warnings.h"

namespace vinebench::sim {
namespace {

/// A panel in two places, one of them twice as large, and a wire.
class MujocoSceneTest : public testing::Test {
 protected:
  MujocoSceneTest() {
    const int box = test::add_material(scene_, Label::kBox, Eigen::Vector3f(1, 0.5f, 0.25f));
    panel_ = test::add_model(scene_, test::panel(box, 0.4, 0.2));
    test::add_instance(scene_, panel_, {1, 2, 0.5});
    test::add_instance(scene_, panel_, {-1, 0, 0});
    scene_.instances[1].scale = 2;
    scene_.wires.push_back({{0, 0, 1}, {2, 0, 1}, 0.003f, box});
  }
  static Eigen::Vector3d place_of(MujocoScene& scene, int geom) {
    return Eigen::Map<const Eigen::Vector3d>(scene.state().geom_xpos + 3 * geom);
  }
  /// The geom of that instance; -1 where there is none.
  static int geom_of(const MujocoScene& scene, int instance) {
    for (int g = 0; g < scene.model().ngeom; ++g) {
      if (scene.instance_of(g) == instance) return g;
    }
    return -1;
  }
  Scene scene_;
  int panel_ = 0;
};

TEST_F(MujocoSceneTest, EveryThingIsAGeomThatKnowsItsInstance) {
  MujocoScene mujoco(scene_, 5);
  EXPECT_EQ(mujoco.model().ngeom, 3);
  const int wire = geom_of(mujoco, -1);
  ASSERT_GE(wire, 0);
  EXPECT_EQ(mujoco.model().geom_type[wire], mjGEOM_CYLINDER);
  EXPECT_NEAR(mujoco.model().geom_size[3 * wire], 0.003, 1e-9);
  EXPECT_LT((place_of(mujoco, wire) - Eigen::Vector3d(1, 0, 1)).norm(), 1e-9);
  for (const int instance : {0, 1}) {
    const int geom = geom_of(mujoco, instance);
    ASSERT_GE(geom, 0);
    EXPECT_EQ(mujoco.model().geom_type[geom], mjGEOM_MESH);
  }
  // Two triangles each, and two tiny ones that give a flat mesh a volume.
  EXPECT_EQ(mujoco.triangles(), 2 * 4);
}

TEST_F(MujocoSceneTest, ColoursOfVerticesAreWarnedOf) {
  const test::Warnings warnings;
  { const MujocoScene plain(scene_, 5); }
  EXPECT_TRUE(warnings.all.empty());
  scene_.materials[0].vertex_colours = true;
  { const MujocoScene coloured(scene_, 5); }
  EXPECT_THAT(warnings.all, testing::ElementsAre(testing::HasSubstr("colours of vertices")));
}

/// MuJoCo puts a mesh's origin at its middle: how far that is from the model's is the same for both
/// instances, but twice as far for the one that is twice as large.
TEST_F(MujocoSceneTest, AnInstanceIsEnlargedAboutItsFoot) {
  MujocoScene mujoco(scene_, 5);
  const int first = geom_of(mujoco, 0), second = geom_of(mujoco, 1);
  const Eigen::Vector3d off = place_of(mujoco, first) - Eigen::Vector3d(1, 2, 0.5);
  EXPECT_LT((place_of(mujoco, second) - Eigen::Vector3d(-1, 0, 0) - 2 * off).norm(), 1e-6);
  const auto axes = [&](int geom) -> Eigen::Matrix3d {
    return Eigen::Map<const Eigen::Matrix<mjtNum, 3, 3, Eigen::RowMajor>>(mujoco.state().geom_xmat +
                                                                          9 * geom);
  };
  EXPECT_NEAR(axes(first).determinant(), 1, 1e-9);
  EXPECT_LT((axes(second) - 2 * axes(first)).norm(), 1e-9);
}

TEST_F(MujocoSceneTest, TheRoverMovesAndIsOutOfSightWhereAbsent) {
  scene_.rover_model = panel_;
  MujocoScene mujoco(scene_, 5);
  const int rover = geom_of(mujoco, -2);
  ASSERT_GE(rover, 0);
  EXPECT_LT(place_of(mujoco, rover).z(), -1000);
  mujoco.place_rover(Pose{});
  const Eigen::Vector3d at_origin = place_of(mujoco, rover);
  EXPECT_LT(at_origin.norm(), 0.5);
  const Pose there{exp_so3({0, 0, 0.7}), {3, 4, 0.2}};
  mujoco.place_rover(there);
  EXPECT_LT((place_of(mujoco, rover) - there * at_origin).norm(), 1e-9);
  mujoco.place_rover(std::nullopt);
  EXPECT_LT(place_of(mujoco, rover).z(), -1000);
}

TEST_F(MujocoSceneTest, ModelsHaveTheLevelOfTheDistance) {
  scene_.models[0].levels[0].until = 4;
  Primitive half = scene_.models[0].levels[0].primitives[0];
  half.indices.resize(3);
  scene_.models[0].levels.push_back({10, {half}});
  EXPECT_EQ(MujocoScene(scene_, 3.9).triangles(), 2 * 4);
  EXPECT_EQ(MujocoScene(scene_, 4.1).triangles(), 2 * 3);
  const MujocoScene beyond(scene_, 11);
  EXPECT_EQ(beyond.model().ngeom, 1);  // the wire
}

TEST_F(MujocoSceneTest, ColoursAreEncoded) {
  const MujocoScene mujoco(scene_, 5);
  ASSERT_GE(mujoco.model().nmat, 1);
  EXPECT_NEAR(mujoco.model().mat_rgba[0], 1, 1e-5);
  EXPECT_NEAR(mujoco.model().mat_rgba[1], std::pow(0.5, 1 / 2.2), 1e-5);
}

TEST_F(MujocoSceneTest, TheImageSizeIsThatOfTheOffscreenBuffer) {
  MujocoScene mujoco(scene_, 5);
  mujoco.set_image_size(123, 45);
  EXPECT_EQ(mujoco.model().vis.global.offwidth, 123);
  EXPECT_EQ(mujoco.model().vis.global.offheight, 45);
}

}  // namespace
}  // namespace vinebench::sim
