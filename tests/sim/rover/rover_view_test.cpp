// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>

#include "core/geometry/rig.h"
#include "core/truth/truth_images.h"
#include "core/util/error.h"
#include "sim/render/gl/gl_renderer.h"
#include "sim/rover/rover_asset.h"
#include "sim/scene/scene_naming.h"
#include "tests/support/test_folder.h"
#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

using namespace test;
using testing::HasSubstr;

const std::filesystem::path kModel =
    std::filesystem::path(VINEBENCH_SOURCE_DIR) / "models/csl-rover/rover.xml";
const Pose kRover{Eigen::Quaterniond::Identity(), {2, 1, 0}};

/// Even ground, and the sun in the west, 45 degrees high: a point at height z casts its shadow z
/// further east.
class RoverViewTest : public testing::Test {
 protected:
  RoverViewTest() {
    add_even_ground(scene_);
    scene_.light.towards_sun = Eigen::Vector3f(-1, 0, 1).normalized();
    add_rover(scene_, kModel);
  }

  RenderedImage draw(const Pose& T_world_cam, const std::optional<Pose>& rover,
                     RenderRequest request = {}) {
    if (!renderer_) renderer_.emplace(scene_, RendererConfig{});
    request.T_world_rover = rover;
    return renderer_->render(camera_, T_world_cam, request);
  }
  int changed_pixels(const Pose& T_world_cam) {
    const cv::Mat with = draw(T_world_cam, kRover).rgb, without = draw(T_world_cam, {}).rgb;
    return cv::countNonZero(cv::Mat(with != without).reshape(1));
  }
  cv::Vec3b at(const cv::Mat& rgb, const Pose& T_world_cam, const Eigen::Vector3d& p) const {
    const Eigen::Vector2d pixel = camera_.project(T_world_cam.inverse() * p);
    EXPECT_TRUE(camera_.contains(pixel, 2));
    return rgb.at<cv::Vec3b>(static_cast<int>(std::lround(pixel.y())),
                             static_cast<int>(std::lround(pixel.x())));
  }

  PinholeCamera camera_ = small_camera();
  Scene scene_;
  std::optional<GlRenderer> renderer_;
};

TEST_F(RoverViewTest, IsSeenFromOutsideWhereItStands) {
  // Between the wheels the chassis' side is visible, 0.13 m off the middle: 1.87 m away.
  const Pose view = look_at({2, -1, 0.165}, {2, 1, 0.165});
  const RenderedImage image =
      draw(view, kRover, {.labels = true, .depth = true, .instances = true, .normals = true});
  EXPECT_EQ(image.labels.at<std::uint8_t>(240, 376), static_cast<std::uint8_t>(Label::kRover));
  EXPECT_NEAR(image.depth.at<float>(240, 376), 1.87f, 1e-3f);
  EXPECT_LT(cv::norm(image.normals.at<cv::Vec3f>(240, 376) - cv::Vec3f(0, 0, -1)), 1e-3);
  const InstanceName name = instance_name(scene_, image.instances.at<std::int32_t>(240, 376));
  EXPECT_EQ(name.thing, Thing::kRover);
  EXPECT_EQ(name.model, "rover");
  const cv::Mat labels = draw(view, {}, {.labels = true}).labels;
  EXPECT_EQ(cv::countNonZero(labels == static_cast<int>(Label::kRover)), 0);
}

// The rover must not be visible in the rig's own images.
TEST_F(RoverViewTest, IsInNoneOfItsOwnImages) {
  const Rig rig = load_rig(kModel.parent_path() / "rig.yaml");
  GlRenderer renderer(scene_, {});
  for (const RigCamera& mounted : rig.cameras) {
    const RenderedImage image = renderer.render(mounted.model, kRover * mounted.T_body_cam,
                                                {.labels = true, .T_world_rover = kRover});
    EXPECT_EQ(cv::countNonZero(image.labels == static_cast<int>(Label::kRover)), 0) << mounted.name;
  }
}

TEST_F(RoverViewTest, ItsShadowLiesWhereTheSunCastsIt) {
  // The camera bar is at a height of 0.475 to 0.505 m and reaches 0.08 m to either side. Its middle
  // casts to x = 2 + 0.49, beyond the shadow of lower parts (0.235 m high, up to 0.22 m ahead).
  const Pose view = above(2.8, 1, 1.0);
  const cv::Mat with = draw(view, kRover).rgb, without = draw(view, {}).rgb;
  const auto dark = [&](double x, double y) {
    return at(with, view, {x, y, 0})[1] < at(without, view, {x, y, 0})[1] - 20;
  };
  for (const double side : {-1.0, 1.0}) {
    // A texel of the map is 3 mm, a pixel here 4 mm, and the comparison is smoothed.
    EXPECT_TRUE(dark(2.49, 1 + side * 0.07));
    EXPECT_FALSE(dark(2.49, 1 + side * 0.09));
  }
  // Its front edge: 0.12 m ahead and 0.505 m high.
  EXPECT_TRUE(dark(2.615, 1));
  EXPECT_FALSE(dark(2.635, 1));
}

TEST_F(RoverViewTest, ItsShadowIsAsDarkAsAPlants) {
  const Pose view = above(2.8, 1, 1.0);
  const cv::Mat by_rover = draw(view, kRover).rgb;
  const int wood = add_material(scene_, Label::kPost, {0.2f, 0.2f, 0.2f});
  add_instance(scene_, add_model(scene_, flat_panel(wood, 0.3)), {2, 1, 0.49});
  renderer_.reset();
  const cv::Vec3b by_sheet = at(draw(view, {}).rgb, view, {2.49, 1, 0});
  // The map of the ground's light holds 8 bits: a grey level or two.
  EXPECT_LE(cv::norm(at(by_rover, view, {2.49, 1, 0}), by_sheet, cv::NORM_INF), 2);
  // Where both overlap the ground is not darker than in one of them.
  const cv::Vec3b by_both = at(draw(view, kRover).rgb, view, {2.49, 1, 0});
  EXPECT_LE(cv::norm(by_both, by_sheet, cv::NORM_INF), 2);
}

TEST_F(RoverViewTest, ItsShadowFallsOnThingsToo) {
  // In the shadow of the camera bar's middle, 0.2 m above the ground.
  const int leaf = add_material(scene_, Label::kLeaf, {0.3f, 0.5f, 0.1f});
  const int carton = add_material(scene_, Label::kBox, {0.5f, 0.3f, 0.2f});
  for (const int material : {leaf, carton}) {
    const double y = material == leaf ? 1.04 : 0.96;
    add_instance(scene_, add_model(scene_, flat_panel(material, 0.03)), {2.29, y, 0.2});
  }
  const Pose view = above(2.8, 1, 1.0);
  const cv::Mat with = draw(view, kRover).rgb, without = draw(view, {}).rgb;
  for (const double y : {0.96, 1.04}) {
    const Eigen::Vector3d p(2.29, y, 0.2);
    EXPECT_LT(at(with, view, p)[1], at(without, view, p)[1] - 20) << y;
  }
}

TEST_F(RoverViewTest, ChangesNothingOutOfView) {
  EXPECT_GT(changed_pixels(look_at({0, 1, 0.5}, {2, 1, 0.3})), 1000);
  // It looks away; beside the shadow; from close by over both.
  EXPECT_EQ(changed_pixels(look_at({3.5, 1, 0.5}, {6, 1, 0.3})), 0);
  EXPECT_EQ(changed_pixels(above(2, 2.2, 1.0)), 0);
  EXPECT_EQ(changed_pixels(look_at({2, 1, 0.75}, {6, 1, 0.75})), 0);
}

TEST_F(RoverViewTest, CastsNoShadowWithoutASun) {
  // The rover's own image ends at x = 2.25, 0.27 m from the middle of what this one shows.
  camera_ = {200, 300, 500, 500, 99.5, 149.5, {}};
  const Pose view = above(2.52, 1, 1.0);
  EXPECT_GT(changed_pixels(view), 1000);
  scene_.light.sun.setZero();
  renderer_.reset();
  EXPECT_EQ(changed_pixels(view), 0);
}

TEST_F(RoverViewTest, DoesNotDependOnWhatWasDrawnBefore) {
  const Pose view = look_at({0, -1, 1}, {2.2, 1, 0});
  const cv::Mat first = draw(view, kRover).rgb;
  draw(view, Pose{Eigen::Quaterniond::Identity(), {2.3, 1.2, 0}});
  draw(view, {});
  EXPECT_EQ(cv::norm(first, draw(view, kRover).rgb, cv::NORM_INF), 0);
}

TEST_F(RoverViewTest, FlowGoesWithTheRover) {
  // Rover and camera drive on together by 0.05 m and turn by 0.02 rad: its image stays in place.
  const Pose later = kRover * Pose{from_roll_pitch_yaw({0, 0, 0.02}), {0.05, 0, 0}};
  const Pose T_rover_cam = kRover.inverse() * look_at({0.8, 0.2, 0.7}, {2, 1, 0.2});
  RenderRequest request = truth_request();
  request.T_world_rover_other = later;
  const TruthView a{camera_, kRover * T_rover_cam, draw(kRover * T_rover_cam, kRover, request)};
  const TruthView b{camera_, later * T_rover_cam, draw(later * T_rover_cam, later, request)};
  const FlowTruth truth = optical_flow(a, b);
  int pixels = 0, visible = 0;
  for (int y = 0; y < camera_.height; ++y) {
    for (int x = 0; x < camera_.width; ++x) {
      if (a.image.labels.at<std::uint8_t>(y, x) != static_cast<std::uint8_t>(Label::kRover)) {
        continue;
      }
      ++pixels;
      if (truth.visible.at<std::uint8_t>(y, x) != 0) ++visible;
      // Float precision of a motion of 0.05 m, and of depth: far below 0.01 px.
      EXPECT_LT(cv::norm(truth.flow.at<cv::Vec2f>(y, x)), 0.01);
    }
  }
  EXPECT_GT(pixels, 2000);
  EXPECT_GT(visible, 0.95 * pixels);  // all except pixels on the edges of rollers
}

}  // namespace
}  // namespace vinebench::sim
