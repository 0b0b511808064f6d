// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/mujoco/mujoco_renderer.h"

#include <gtest/gtest.h>

#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

using namespace test;

/// Red and green above, blue and white below.
cv::Mat four_colours() {
  cv::Mat rgba(64, 64, CV_8UC4, cv::Scalar(255, 255, 255, 255));
  rgba(cv::Rect(0, 0, 32, 32)) = cv::Scalar(255, 0, 0, 255);
  rgba(cv::Rect(32, 0, 32, 32)) = cv::Scalar(0, 255, 0, 255);
  rgba(cv::Rect(0, 32, 32, 32)) = cv::Scalar(0, 0, 255, 255);
  return rgba;
}

/// Which of R (1), G (2), B (4) a pixel has more than half as much of as its strongest channel.
int hue(const cv::Mat& rgb, const Eigen::Vector2d& at) {
  const cv::Vec3b pixel = rgb.at<cv::Vec3b>(
      cv::Point(static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y()))));
  const int strongest = std::max({pixel[0], pixel[1], pixel[2]});
  int channels = 0;
  for (int c = 0; c < 3; ++c) channels += 2 * pixel[c] > strongest ? 1 << c : 0;
  return channels;
}

class MujocoRendererTest : public testing::Test {
 protected:
  MujocoRendererTest() {
    const int material = add_material(scene_, Label::kBox, Eigen::Vector3f::Ones(), four_colours());
    add_instance(scene_, add_model(scene_, panel(material, 0.4, 0.2)), {0.1, 0, 0.3});
  }
  cv::Mat render(const MujocoRendererConfig& config = {}) {
    return MujocoRenderer(scene_, config).render(small_camera(), T_world_cam_, {}).rgb;
  }
  Eigen::Vector2d pixel(double x, double z) const {
    return small_camera().project(T_world_cam_.inverse() * Eigen::Vector3d(x, 0, z));
  }

  Scene scene_;
  Pose T_world_cam_ = look_at({0.3, -1, 0.5}, {0, 0, 0.2}, 0.3);
};

TEST_F(MujocoRendererTest, SeesAPanelWhereTheCameraModelProjectsIt) {
  const cv::Mat rgb = render();
  ASSERT_EQ(rgb.size(), cv::Size(752, 480));
  // The panel spans 0.4 m x 0.2 m around (0.1, 0.3). At about 1 m a centimetre is 2.6 px; colours
  // change at the panel's middle, 2 cm (5 px) from each point.
  for (const double d : {0.02, 0.08}) {
    EXPECT_EQ(hue(rgb, pixel(0.1 - d, 0.3 + d)), 1) << d;
    EXPECT_EQ(hue(rgb, pixel(0.1 + d, 0.3 + d)), 2) << d;
    EXPECT_EQ(hue(rgb, pixel(0.1 - d, 0.3 - d)), 4) << d;
    EXPECT_EQ(hue(rgb, pixel(0.1 + d, 0.3 - d)), 7) << d;
  }
}

TEST_F(MujocoRendererTest, EnlargesAnInstanceAboutItsFoot) {
  // Twice as large the panel spans 0.8 m: red at 0.3 m left of its middle, where sky was before.
  EXPECT_NE(hue(render(), pixel(-0.2, 0.35)), 1);
  scene_.instances[0].scale = 2;
  EXPECT_EQ(hue(render(), pixel(-0.2, 0.35)), 1);
}

TEST_F(MujocoRendererTest, PutsWhatMovesWhereItIsAtThatTime) {
  // Twice as large, and 0.2 m further left after 2 s: its middle goes from x = 0.1 m to -0.1 m.
  scene_.instances[0].scale = 2;
  add_motion(scene_, {0.1, 0, 0.3}, {-0.1, 0, 0});
  MujocoRenderer renderer(scene_, {});
  const auto render_at = [&](double time) {
    return renderer.render(small_camera(), T_world_cam_, {.time = time}).rgb;
  };
  const cv::Mat now = render_at(0), later = render_at(2);
  // Red is left of the middle and green right of it.
  EXPECT_EQ(hue(now, pixel(0, 0.4)), 1);
  EXPECT_EQ(hue(later, pixel(0, 0.4)), 2);
  EXPECT_EQ(hue(later, pixel(-0.2, 0.4)), 1);
}

TEST_F(MujocoRendererTest, TakesTheLevelOfTheDistance) {
  LevelOfDetail coarse = scene_.models[0].levels[0];
  coarse.primitives[0].indices.resize(3);
  scene_.models[0].levels[0].until = 2;
  scene_.models[0].levels.push_back(coarse);
  MujocoRendererConfig near;
  MujocoRendererConfig far;
  far.level_distance = 3;
  // Each mesh has two additional tiny triangles.
  EXPECT_EQ(MujocoRenderer(scene_, near).triangles(), 4);
  EXPECT_EQ(MujocoRenderer(scene_, far).triangles(), 3);
}

}  // namespace
}  // namespace vinebench::sim
