// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/shadows/moving_shadow.h"

#include <gtest/gtest.h>

#include <optional>

#include "sim/render/gl/gl_renderer.h"
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

}  // namespace
}  // namespace vinebench::sim
