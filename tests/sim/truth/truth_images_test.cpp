// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/truth/truth_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/render/gl/gl_renderer.h"
#include "sim/scene/scene_naming.h"
#include "sim/sensors/camera/camera_sensor.h"
#include "sim/sensors/sensors.h"
#include "tests/support/test_folder.h"
#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

using namespace test;
using testing::HasSubstr;

constexpr double kBaseline = 0.2;  // m

/// A panel of 0.5 x 3 m at 2 m in front of one of 4 x 1 m at 3 m, surrounded by sky. Both cameras
/// look along +y, the right one 0.2 m beside the left one.
class TwoPanelsTruthTest : public testing::Test {
 protected:
  TwoPanelsTruthTest() {
    const int box = add_material(scene_, Label::kBox, {0.8f, 0.1f, 0.1f});
    const int post = add_material(scene_, Label::kPost, {0.1f, 0.8f, 0.1f});
    add_instance(scene_, add_model(scene_, panel(box, 4, 1)), {0, 3, 0});
    add_instance(scene_, add_model(scene_, panel(post, 0.5, 3)), {0, 2, 0});
    light_evenly(scene_);
  }
  TruthView view(const Pose& T_world_cam) {
    if (!renderer_) renderer_.emplace(scene_, RendererConfig{});
    return {camera_, T_world_cam, renderer_->render(camera_, T_world_cam, truth_request())};
  }
  static Pose camera_at(double x) { return look_at({x, 0, 0}, {x, 1, 0}); }

  /// Whether u is within 0.6 px of one of the edges: pixels there are ambiguous.
  static bool on_edge(double u, std::initializer_list<double> edges) {
    return std::ranges::any_of(edges, [u](double edge) { return std::abs(u - edge) < 0.6; });
  }

  PinholeCamera camera_ = small_camera();
  Scene scene_;
  std::optional<GlRenderer> renderer_;
};

TEST_F(TwoPanelsTruthTest, TheOcclusionMaskIsWhatTheDrawingSays) {
  const DisparityTruth truth = disparity(view(camera_at(0)), view(camera_at(kBaseline)));
  ASSERT_EQ(truth.disparity.type(), CV_32FC1);
  ASSERT_EQ(truth.visible.type(), CV_8UC1);
  const auto pixel = [&](double x, double depth) { return camera_.fx * x / depth + camera_.cx; };
  // The right camera's ray to (X, 3) crosses y = 2 at 0.2 + (X - 0.2) * 2 / 3, which the near panel
  // blocks for -0.475 < X < 0.275; the left camera sees |X| > 0.375 beside it.
  const double hidden = pixel(-0.475, 3), near_left = pixel(-0.25, 2), near_right = pixel(0.25, 2);
  for (const int v : {220, 239, 260}) {
    for (int u = static_cast<int>(pixel(-2, 3)) + 2; u < pixel(2, 3) - 1; ++u) {
      if (on_edge(u, {hidden, near_left, near_right})) continue;
      const bool near = u > near_left && u < near_right;
      EXPECT_NEAR(truth.disparity.at<float>(v, u), camera_.fx * kBaseline / (near ? 2 : 3), 0.01);
      EXPECT_EQ(truth.visible.at<std::uint8_t>(v, u) != 0, u < hidden || u > near_left) << u;
    }
  }
  // Above the far panel there is sky at the same pixel of both cameras; the right one sees the near
  // panel from X = -0.45 to 0.05 of its own.
  const double from = pixel(-0.45, 2), to = pixel(0.05, 2);
  for (int u = 0; u < camera_.width; ++u) {
    if (on_edge(u, {from, to, near_left, near_right})) continue;
    const bool near = u > near_left && u < near_right;
    const bool hidden_sky = !near && u > from && u < to;
    EXPECT_NEAR(truth.disparity.at<float>(100, u), near ? camera_.fx * kBaseline / 2 : 0, 0.01);
    EXPECT_EQ(truth.visible.at<std::uint8_t>(100, u) != 0, !hidden_sky) << u;
  }
}

TEST_F(TwoPanelsTruthTest, FlowIsWhereThePlanesPointsGo) {
  const TruthView a = view(camera_at(0));
  const TruthView b = view(look_at({0.1, 0.3, -0.05}, {0.2, 2, 0.1}, 0.1));
  const FlowTruth truth = optical_flow(a, b);
  int compared = 0, outside = 0;
  for (int v = 2; v < camera_.height; v += 7) {
    for (int u = 3; u < camera_.width; u += 5) {
      const Eigen::Vector3d ray = camera_.unproject({u, v});
      const bool near = std::abs(ray.x()) * 2 < 0.25 && std::abs(ray.y()) * 2 < 1.5;
      const bool far = !near && std::abs(ray.x()) * 3 < 2 && std::abs(ray.y()) * 3 < 0.5;
      const auto flow = truth.flow.at<cv::Vec2f>(v, u);
      Eigen::Vector3d p_b = b.T_world_cam.inverse() * (a.T_world_cam * ((near ? 2 : 3) * ray));
      if (!near && !far) p_b = b.T_world_cam.rotation.conjugate() * (a.T_world_cam.rotation * ray);
      const Eigen::Vector2d place = camera_.project(p_b);
      // Depth of 0.02 mm at 3 m moves a point by less than 0.001 px.
      EXPECT_NEAR(u + flow[0], place.x(), 0.005);
      EXPECT_NEAR(v + flow[1], place.y(), 0.005);
      ++compared;
      if (camera_.contains(place)) continue;
      EXPECT_EQ(truth.visible.at<std::uint8_t>(v, u), 0);
      ++outside;
    }
  }
  EXPECT_GT(compared, 10000);
  EXPECT_GT(outside, 100);
}

TEST_F(TwoPanelsTruthTest, NumbersSayWhatTheyStandFor) {
  scene_.models[1].name = "line post";
  scene_.instances[1].id = 17;
  const InstanceName name = instance_name(scene_, 256 * 2 + 5);
  EXPECT_EQ(name.thing, Thing::kPost);
  EXPECT_EQ(name.index, 1);
  EXPECT_EQ(name.id, 17);
  EXPECT_EQ(name.part, 5);
  EXPECT_EQ(name.model, "line post");
  EXPECT_EQ(name_of(name.thing), "post");
  EXPECT_EQ(instance_name(scene_, 0).thing, Thing::kNone);
  EXPECT_THAT(error_of([&] { instance_name(scene_, 256 * 3); }), HasSubstr("2 instances"));
  EXPECT_THAT(error_of([&] { instance_name(scene_, 9); }), HasSubstr("instance number 9"));
}

/// The two panels through a lens of strong distortion and bands of rows.
class LensTruthTest : public TwoPanelsTruthTest {
 protected:
  RenderedImage capture(const RigCamera& camera, int bands) {
    if (!renderer_) renderer_.emplace(scene_, RendererConfig{});
    CameraSensorConfig config = perfect_sensors().camera;
    config.readout_time = bands > 1 ? 1e-3 : 0;
    config.readout_bands = std::max(2, bands);
    CameraSensor sensor(config, camera, 0, 1, scene_.light);
    Shot shot;
    shot.exposure = {*config.exposure.time, config.exposure.gain_db};
    shot.request = truth_request();
    return sensor.capture(
        shot, [&](Stamp) { return camera_at(0); },
        [&](const PinholeCamera& view, const Pose& pose, const RenderRequest& request) {
          return renderer_->render(view, pose, request);
        });
  }
};

TEST_F(LensTruthTest, EveryImageIsBentAlikeToTheNearestPixel) {
  const RigCamera camera{
      "left", {400, 300, 150, 150, 199.5, 149.5, {-0.15, 0.02, 0.001, -0.002}}, {}};
  for (const int bands : {1, 7}) {
    const RenderedImage image = capture(camera, bands);
    ASSERT_EQ(image.instances.size(), image.labels.size());
    ASSERT_EQ(image.normals.size(), image.labels.size());
    ASSERT_TRUE(image.motion.empty());  // nothing moves
    int compared = 0;
    for (int v = 0; v < 300; ++v) {
      for (int u = 0; u < 400; ++u) {
        const Eigen::Vector3d ray = camera.model.unproject({u, v});
        // The view has at least the lens's focal length: its nearest pixel is 0.5 px off at most.
        const double margin = 0.55 / 150;
        const double x = std::abs(ray.x()), y = std::abs(ray.y());
        if (std::abs(x - 0.125) < margin || std::abs(y - 0.75) < margin ||
            std::abs(x - 2 / 3.0) < margin || std::abs(y - 0.5 / 3) < margin) {
          continue;
        }
        const bool near = x < 0.125 && y < 0.75;
        const bool far = !near && x < 2 / 3.0 && y < 0.5 / 3;
        const Label label = near ? Label::kPost : far ? Label::kBox : Label::kSky;
        ASSERT_EQ(image.labels.at<std::uint8_t>(v, u), static_cast<int>(label))
            << u << ", " << v << ", bands " << bands;
        ASSERT_EQ(image.instances.at<std::int32_t>(v, u), near ? 512 : far ? 256 : 0);
        ASSERT_NEAR(image.depth.at<float>(v, u), near ? 2 : far ? 3 : 0, 1e-4);
        ASSERT_NEAR(image.normals.at<cv::Vec3f>(v, u)[2], near || far ? -1 : 0, 1e-4);
        ++compared;
      }
    }
    EXPECT_GT(compared, 0.95 * 400 * 300);
  }
}

}  // namespace
}  // namespace vinebench::sim
