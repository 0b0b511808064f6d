// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "core/truth/truth_images.h"
#include "sim/render/gl/gl_renderer.h"
#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

using namespace test;

/// A camera that looks along +y at a panel of 1 x 1 m, 3 m away, before a wall at 5 m. The panel
/// goes 1 m/s to the right and 0.5 m/s away.
class MovingInstanceTest : public testing::Test {
 protected:
  MovingInstanceTest() {
    const int wall = add_material(scene_, Label::kPost, {0.2f, 0.6f, 0.2f});
    const int board = add_material(scene_, Label::kBox, {0.8f, 0.2f, 0.2f});
    add_instance(scene_, add_model(scene_, panel(wall, 20, 12)), {0, 5, 0});
    add_instance(scene_, add_model(scene_, panel(board, 1, 1)), {0, 3, 0});
    add_motion(scene_, {0, 3, 0}, {1, 0.5, 0});
    light_evenly(scene_);
  }
  TruthView view(double time, double other_time) {
    if (!renderer_) renderer_.emplace(scene_, RendererConfig{});
    return {camera_, camera_pose_,
            renderer_->render(camera_, camera_pose_, truth_request(time, other_time))};
  }
  int column(double x, double y) const {
    return static_cast<int>(std::lround(camera_.fx * x / y + camera_.cx));
  }

  PinholeCamera camera_ = small_camera();
  Pose camera_pose_ = look_at({0, 0, 0}, {0, 1, 0});
  Scene scene_;
  std::optional<GlRenderer> renderer_;
};

TEST_F(MovingInstanceTest, IsSeenWhereItIsAtThatTime) {
  const RenderedImage image = view(1, 1).image;
  // After 1 s at (1, 3.5).
  const int there = column(1, 3.5), before = column(0, 3);
  EXPECT_EQ(image.labels.at<std::uint8_t>(239, there), static_cast<int>(Label::kBox));
  EXPECT_EQ(image.instances.at<std::int32_t>(239, there), 256 * 2);
  EXPECT_NEAR(image.depth.at<float>(239, there), 3.5, 1e-4);
  EXPECT_EQ(image.labels.at<std::uint8_t>(239, before), static_cast<int>(Label::kPost));
  EXPECT_EQ(image.instances.at<std::int32_t>(239, before), 256);
}

TEST_F(MovingInstanceTest, FlowGoesWithIt) {
  const TruthView a = view(0, 0.2), b = view(0.2, 0);
  const FlowTruth flow = optical_flow(a, b);
  int compared = 0;
  for (int u = column(-0.45, 3); u < column(0.45, 3); u += 5) {
    // The point (x, 3) goes to (x + 0.2, 3.1).
    const double x = 3 * (u - camera_.cx) / camera_.fx;
    const double expected = camera_.fx * (x + 0.2) / 3.1 + camera_.cx - u;
    EXPECT_NEAR(flow.flow.at<cv::Vec2f>(239, u)[0], expected, 0.005);
    EXPECT_NE(flow.visible.at<std::uint8_t>(239, u), 0) << u;
    ++compared;
  }
  EXPECT_GT(compared, 10);
  // The wall keeps still, and is hidden where the board goes: its right side at 0.7 / 3.1.
  const int covered = column(0.6, 3.1), free = column(-1, 3);
  EXPECT_NEAR(flow.flow.at<cv::Vec2f>(239, covered)[0], 0, 0.001);
  EXPECT_EQ(flow.visible.at<std::uint8_t>(239, covered), 0);
  EXPECT_NE(flow.visible.at<std::uint8_t>(239, free), 0);
}

TEST_F(MovingInstanceTest, MotionNeedsNoOtherTruth) {
  view(0, 0);
  RenderRequest request;
  request.motion = true;
  request.other_time = 2;
  const RenderedImage image = renderer_->render(camera_, camera_pose_, request);
  EXPECT_TRUE(image.instances.empty());
  EXPECT_TRUE(image.labels.empty());
  EXPECT_LT(cv::norm(image.motion.at<cv::Vec3f>(239, 375) - cv::Vec3f(2, 1, 0)), 1e-5);
  EXPECT_EQ(image.motion.at<cv::Vec3f>(239, 10), cv::Vec3f(0, 0, 0));
}

}  // namespace
}  // namespace vinebench::sim
