// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/shadows/rover_shadow.h"

#include "tests/support/gl_fixture.h"
#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

/// A rover that is an upright board of 1 m x 1 m half a metre above the ground, 3 m ahead of a
/// camera that looks along +y; the sun stands behind the
/// camera, 45 degrees high.
class RoverShadowTest : public test::GlTest {
 protected:
  RoverShadowTest() {
    const int material = test::add_material(scene_, Label::kRover, Eigen::Vector3f::Ones());
    scene_.rover_model = test::add_model(scene_, test::panel(material, 1, 1));
    scene_.light.towards_sun = Eigen::Vector3f(0, -1, 1).normalized();
  }
  bool cast(int size = 64) const {
    const GpuScene gpu(gl_, scene_);
    RoverShadow shadow(gpu, size);
    return shadow.cast(gpu, T_world_rover_, test::small_camera(), T_world_cam_);
  }
  Scene scene_;
  Pose T_world_rover_{Eigen::Quaterniond::Identity(), {0, 3, 0.5}};
  Pose T_world_cam_ = test::look_at({0, 0, 0.5}, {0, 1, 0.5});
};

TEST_F(RoverShadowTest, IsCastWhereItMayBeInView) {
  EXPECT_TRUE(cast());
  T_world_cam_ = test::look_at({0, 0, 0.5}, {0, -1, 0.5});
  EXPECT_FALSE(cast());
  // The rover itself is behind the camera, its shadow falls before it.
  T_world_rover_.translation = {0, -0.5, 0.5};
  T_world_cam_ = test::look_at({0, 0.2, 0.8}, {0, 1.2, 0});
  EXPECT_TRUE(cast());
}

TEST_F(RoverShadowTest, ThereIsNoneWithoutSunRoverOrPixels) {
  EXPECT_FALSE(cast(0));
  scene_.light.towards_sun = Eigen::Vector3f(0, -1, 0.01f).normalized();  // at the horizon
  EXPECT_FALSE(cast());
  scene_.light.towards_sun = Eigen::Vector3f(0, -1, 1).normalized();
  scene_.light.sun.setZero();
  EXPECT_FALSE(cast());
  scene_.light.sun.setOnes();
  EXPECT_TRUE(cast());
  scene_.rover_model = -1;
  EXPECT_FALSE(cast());
}

TEST_F(RoverShadowTest, ShadesWhatLiesBehindItFromTheSun) {
  const GpuScene gpu(gl_, scene_);
  RoverShadow shadow(gpu, 64);
  ASSERT_TRUE(shadow.cast(gpu, T_world_rover_, test::small_camera(), T_world_cam_));
  EXPECT_TRUE(shadow.may_shade({0, 4, -0.5}, 0.01));    // 1 m farther and lower
  EXPECT_FALSE(shadow.may_shade({0, 2, 1.5}, 0.01));    // towards the sun
  EXPECT_FALSE(shadow.may_shade({0.8, 4, -0.5}, 0.2));  // beside
  EXPECT_TRUE(shadow.may_shade({0.8, 4, -0.5}, 0.35));  // a ball that reaches to x = 0.45
}

TEST_F(RoverShadowTest, TheMapHasTheRoversDepth) {
  const GpuScene gpu(gl_, scene_);
  RoverShadow shadow(gpu, 64);
  ASSERT_TRUE(shadow.cast(gpu, T_world_rover_, test::small_camera(), T_world_cam_));
  const auto in_map = [&](const Eigen::Vector3d& p_world) -> Eigen::Vector3d {
    return (shadow.map_from_world() * p_world.homogeneous()).head<3>();
  };
  EXPECT_LT((in_map({0, 3, 0.5}) - Eigen::Vector3d::Constant(0.5)).norm(), 1e-9);
  const cv::Mat depth = depths(shadow.texture(), 64);
  // Drawn in two halves; the map's depth is kept a little farther so that it does not shade itself.
  const Eigen::Vector3d p = in_map({0.3, 3, 0.7});
  const double drawn = static_cast<double>(
      depth.at<float>(static_cast<int>(64 * p.y()), static_cast<int>(64 * p.x())));
  EXPECT_GE(drawn, p.z() - 0.01);
  EXPECT_LT(drawn, p.z() + 0.1);
}

TEST_F(RoverShadowTest, MovesWithTheRover) {
  const GpuScene gpu(gl_, scene_);
  RoverShadow shadow(gpu, 64);
  ASSERT_TRUE(shadow.cast(gpu, T_world_rover_, test::small_camera(), T_world_cam_));
  T_world_rover_.translation.x() = 2;
  ASSERT_TRUE(shadow.cast(gpu, T_world_rover_, test::small_camera(), T_world_cam_));
  EXPECT_FALSE(shadow.may_shade({0, 4, -0.5}, 0.01));
  EXPECT_TRUE(shadow.may_shade({2, 4, -0.5}, 0.01));
}

}  // namespace
}  // namespace vinebench::sim
