// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/scene/view_block.h"

#include <cmath>

#include "sim/render/gl/scene/frustum.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

TEST(EncodedTest, IsThePowerOfLight) {
  EXPECT_EQ(encoded(1), 1);
  EXPECT_NEAR(encoded(0.5), std::exp2(-1 / 2.2), 1e-6);
  EXPECT_EQ(encoded(-0.1), 0);
}

TEST(HorizonLightTest, IsPalerThanAClearSkyAndGreyUnderClouds) {
  Light light;
  light.sky = {0.2f, 0.4f, 0.6f};
  EXPECT_LT((horizon_light(light) - 0.5f * Eigen::Vector3f(0.31f, 0.60f, 0.81f)).norm(), 1e-6f);
  light.overcast = 1;
  EXPECT_LT((horizon_light(light) - 0.5f * 1.25f * light.sky).norm(), 1e-6f);
  light.overcast = 0.5;
  EXPECT_NEAR(horizon_light(light).x(), 0.5 * (0.31 + 0.25) / 2, 1e-6);
}

class ViewBlockTest : public testing::Test {
 protected:
  ViewBlock block() const {
    return make_view_block(test::small_camera(), T_world_cam_, light_, wind_, settings_);
  }
  Pose T_world_cam_ = test::look_at({1, 2, 3}, {4, 1, 2}, 0.2);
  Light light_;
  Wind wind_;
  ViewSettings settings_;
};

TEST_F(ViewBlockTest, HasTheCameraInItsPlace) {
  const ViewBlock b = block();
  EXPECT_LT((b.cam_from_world * b.world_from_cam - Eigen::Matrix4f::Identity()).norm(), 1e-5f);
  EXPECT_LT((b.world_from_cam.col(3).head<3>() - Eigen::Vector3f(1, 2, 3)).norm(), 1e-6f);
  EXPECT_LT((b.clip_from_cam - clip_from_cam(test::small_camera()).cast<float>()).norm(), 1e-6f);
  EXPECT_NEAR(b.lens.x(), 263.2786, 1e-3);
}

TEST_F(ViewBlockTest, TheSunAndUpAreInTheCamerasFrame) {
  light_.towards_sun = Eigen::Vector3f(1, 2, 2) / 3;
  const ViewBlock b = block();
  const Eigen::Matrix3f R_world_cam = T_world_cam_.rotation.toRotationMatrix().cast<float>();
  EXPECT_LT((R_world_cam * b.towards_sun.head<3>() - light_.towards_sun).norm(), 1e-6f);
  EXPECT_LT((R_world_cam * b.up.head<3>() - Eigen::Vector3f::UnitZ()).norm(), 1e-6f);
}

TEST_F(ViewBlockTest, ExposureScalesAllLight) {
  light_.sun = {1, 0.8f, 0.6f};
  light_.haze = 0.01f;
  const ViewBlock plain = block();
  settings_.exposure = 0.25;
  const ViewBlock dim = block();
  EXPECT_LT((dim.sun - 0.25f * plain.sun).norm(), 1e-6f);
  EXPECT_LT((dim.sky - 0.25f * plain.sky).norm(), 1e-6f);
  EXPECT_LT((dim.bounce - 0.25f * plain.bounce).norm(), 1e-6f);
  // Encoded, a quarter of the light is its 2.2nd root; the extinction is no light.
  const float root = encoded(0.25);
  EXPECT_LT((dim.haze.head<3>() - root * plain.haze.head<3>()).norm(), 1e-5f);
  EXPECT_EQ(dim.haze.w(), 0.01f);
  EXPECT_NEAR(dim.lens.z(), root * plain.lens.z(), 1e-6);
}

TEST_F(ViewBlockTest, TheWindSwaysByItsSpeed) {
  wind_.speed = 5;
  wind_.towards = {0, -1};
  wind_.seed = 3;
  settings_.time = 1.5;
  settings_.other_time = 1.6;
  const ViewBlock b = block();
  EXPECT_LT((b.gust - Eigen::Vector4f(0, -0.03f, 1.5f, 1.6f)).norm(), 1e-6f);  // 6 mm for 1 m/s
  wind_.seed = 4;
  EXPECT_NE(block().gust_phase, b.gust_phase);
}

class ViewBufferTest : public test::GlTest {};

/// The members' order is that of the shaders' uniform block.
TEST_F(ViewBufferTest, ShadersReadTheBlockAsItIsLaidOut) {
  ViewBlock block;
  block.moving_shadow_from_cam(1, 2) = 0.2f;
  block.sun.x() = 0.4f;
  block.gust.w() = 0.6f;
  block.lens.z() = 0.8f;
  const ViewBuffer buffer(gl_);
  buffer.set(block);
  const cv::Mat seen = shade(1, 1, R"(#version 420 core
layout(std140, binding = 0) uniform View {
  mat4 clip_from_cam, cam_from_world, world_from_cam, shadow_from_cam, moving_shadow_from_cam;
  vec4 towards_sun, up, sun, sky, bounce, haze, light_map, gust, gust_phase, lens;
};
layout(location = 0) out vec4 colour;
void main() { colour = vec4(moving_shadow_from_cam[2][1], sun.x, gust.w, lens.z); })");
  EXPECT_EQ(seen.at<cv::Vec4b>(0, 0), cv::Vec4b(51, 102, 153, 204));
}

}  // namespace
}  // namespace vinebench::sim
