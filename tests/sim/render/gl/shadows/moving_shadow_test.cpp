// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/shadows/moving_shadow.h"

#include <gtest/gtest.h>

#include <optional>

#include "sim/render/gl/gl_renderer.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

using namespace test;

/// A square of 0.4 m, 0.5 m above even ground, that flies from (2, 1) 1 m/s to the east. The sun is
/// in the west, 45 degrees high: the shadow is 0.5 m east of it.
class MovingShadowTest : public testing::Test {
 protected:
  MovingShadowTest() {
    add_even_ground(scene_);
    scene_.light.towards_sun = Eigen::Vector3f(-1, 0, 1).normalized();
    add_mover({2, 1, 0.5}, {1, 0, 0});
  }

  void add_mover(const Eigen::Vector3d& from, const Eigen::Vector3d& velocity) {
    const int wood = add_material(scene_, Label::kBox, {0.5f, 0.5f, 0.5f});
    add_instance(scene_, add_model(scene_, flat_panel(wood, 0.4)), from);
    add_motion(scene_, from, velocity);
  }

  /// Green of the ground at (x, 1), seen from above.
  int light(double x, double time) {
    if (!renderer_) renderer_.emplace(scene_, RendererConfig{});
    const Pose view = above(x, 1, 0.4);
    return renderer_->render(small_camera(), view, {.time = time}).rgb.at<cv::Vec3b>(239, 375)[1];
  }

  Scene scene_;
  std::optional<GlRenderer> renderer_;
};

TEST_F(MovingShadowTest, LiesWhereTheSunCastsItAtThatTime) {
  const int open = light(6, 0);
  for (const double time : {0.0, 1.0, 2.0}) {
    const double middle = 2.5 + time;
    // A texel of the map is less than a millimetre here; 2 cm leave room for its smoothing.
    for (const double inside : {-0.18, 0.0, 0.18}) {
      EXPECT_LT(light(middle + inside, time), open - 20) << time << " " << inside;
    }
    for (const double outside : {-0.22, 0.22}) {
      EXPECT_GT(light(middle + outside, time), open - 5) << time << " " << outside;
    }
  }
}

TEST_F(MovingShadowTest, IsNotLeftBehindInTheMapsThatAreDrawnOnce) {
  EXPECT_GT(light(2.5, 3), light(6, 3) - 5);
}

TEST_F(MovingShadowTest, EachOfSeveralCastsIts) {
  add_mover({4, 1, 0.5}, {-1, 0, 0});
  const int open = light(7, 0);
  for (const double x : {2.5, 4.5}) EXPECT_LT(light(x, 0), open - 20) << x;
  EXPECT_GT(light(3.5, 0), open - 5);
}

TEST_F(MovingShadowTest, WithoutSunThereIsNone) {
  scene_.light.sun.setZero();
  EXPECT_EQ(light(2.5, 0), light(6, 0));
}

/// A rover that is an upright board of 1 m x 1 m, 3 m ahead of a camera that looks along +y and
/// half a metre above the ground; the sun stands behind the camera, 45 degrees high.
class CastShadowTest : public test::GlTest {
 protected:
  CastShadowTest() {
    const int material = test::add_material(scene_, Label::kRover, Eigen::Vector3f::Ones());
    scene_.rover_model = test::add_model(scene_, test::panel(material, 1, 1));
    scene_.light.towards_sun = Eigen::Vector3f(0, -1, 1).normalized();
  }
  bool cast(int size = 64) const {
    const GpuScene gpu(gl_, scene_);
    MovingShadow shadow(gpu, size);
    return shadow.cast(gpu, gpu.movers(0, T_world_rover_), test::small_camera(), T_world_cam_);
  }
  Scene scene_;
  Pose T_world_rover_{Eigen::Quaterniond::Identity(), {0, 3, 0.5}};
  Pose T_world_cam_ = test::look_at({0, 0, 0.5}, {0, 1, 0.5});
};

TEST_F(CastShadowTest, IsCastWhereItMayBeInView) {
  EXPECT_TRUE(cast());
  T_world_cam_ = test::look_at({0, 0, 0.5}, {0, -1, 0.5});
  EXPECT_FALSE(cast());
  // The rover itself is behind the camera, its shadow falls before it.
  T_world_rover_.translation = {0, -0.5, 0.5};
  T_world_cam_ = test::look_at({0, 0.2, 0.8}, {0, 1.2, 0});
  EXPECT_TRUE(cast());
}

TEST_F(CastShadowTest, ThereIsNoneWithoutSunRoverOrPixels) {
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

TEST_F(CastShadowTest, ShadesWhatLiesBehindItFromTheSun) {
  const GpuScene gpu(gl_, scene_);
  MovingShadow shadow(gpu, 64);
  ASSERT_TRUE(shadow.cast(gpu, gpu.movers(0, T_world_rover_), test::small_camera(), T_world_cam_));
  EXPECT_TRUE(shadow.may_shade({0, 4, -0.5}, 0.01));    // 1 m farther and lower
  EXPECT_FALSE(shadow.may_shade({0, 2, 1.5}, 0.01));    // towards the sun
  EXPECT_FALSE(shadow.may_shade({0.8, 4, -0.5}, 0.2));  // beside
  EXPECT_TRUE(shadow.may_shade({0.8, 4, -0.5}, 0.35));  // a ball that reaches to x = 0.45
}

TEST_F(CastShadowTest, TheMapHasTheDepthOfWhatMoves) {
  const GpuScene gpu(gl_, scene_);
  MovingShadow shadow(gpu, 64);
  ASSERT_TRUE(shadow.cast(gpu, gpu.movers(0, T_world_rover_), test::small_camera(), T_world_cam_));
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

TEST_F(CastShadowTest, MovesWithTheRover) {
  const GpuScene gpu(gl_, scene_);
  MovingShadow shadow(gpu, 64);
  ASSERT_TRUE(shadow.cast(gpu, gpu.movers(0, T_world_rover_), test::small_camera(), T_world_cam_));
  T_world_rover_.translation.x() = 2;
  ASSERT_TRUE(shadow.cast(gpu, gpu.movers(0, T_world_rover_), test::small_camera(), T_world_cam_));
  EXPECT_FALSE(shadow.may_shade({0, 4, -0.5}, 0.01));
  EXPECT_TRUE(shadow.may_shade({2, 4, -0.5}, 0.01));
}

}  // namespace
}  // namespace vinebench::sim
