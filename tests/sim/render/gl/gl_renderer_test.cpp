// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/gl_renderer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <thread>

#include "core/util/error.h"
#include "tests/support/chessboard.h"
#include "tests/support/tag_reading.h"
#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

using namespace test;

cv::Mat grey_of(const RenderedImage& image) {
  cv::Mat grey;
  cv::cvtColor(image.rgb, grey, cv::COLOR_RGB2GRAY);
  return grey;
}

class ChessboardTest : public testing::Test {
 protected:
  static double worst_corner(GlRenderer& renderer, const PinholeCamera& camera,
                             const Pose& T_world_cam) {
    return Chessboard::worst_corner(renderer.render(camera, T_world_cam, {}).rgb, camera,
                                    T_world_cam);
  }
  Scene scene_ = Chessboard::scene();
};

// Required: 0.1 px, a tenth of the accuracy of a feature's corner.
TEST_F(ChessboardTest, CornersAreWhereTheCameraProjectsThem) {
  GlRenderer renderer(scene_, {});
  const Eigen::Vector3d centre(0.02, 0, -0.01);
  const std::vector<Pose> poses{look_at({0, -0.45, 0}, centre), look_at({0.2, -0.4, 0.1}, centre),
                                look_at({-0.15, -0.5, -0.2}, centre, 0.3),
                                look_at({0.05, -0.6, 0.25}, centre, -0.7)};
  for (const Pose& pose : poses) {
    EXPECT_LT(worst_corner(renderer, small_camera(), pose), 0.1);
    EXPECT_LT(worst_corner(renderer, large_camera(), pose), 0.1);
  }
}

TEST_F(ChessboardTest, AnOffCentrePrincipalPointAndUnequalFocalLengthsAreKept) {
  GlRenderer renderer(scene_, {});
  PinholeCamera camera{700, 500, 300, 330, 310.25, 270.5, {}};
  EXPECT_LT(worst_corner(renderer, camera, look_at({0.1, -0.5, 0.1}, {0, 0, 0})), 0.1);
}

TEST_F(ChessboardTest, FarFromTheWorldsOriginNothingMoves) {
  const Eigen::Vector3d far_away(3000, -2000, 10);
  scene_.instances[0].T_world_model.translation = far_away;
  GlRenderer renderer(scene_, {});
  Pose pose = look_at({0.1, -0.5, 0.1}, {0, 0, 0});
  GlRenderer near_renderer(
      [&] {
        Scene near_scene = scene_;
        near_scene.instances[0].T_world_model.translation.setZero();
        return near_scene;
      }(),
      {});
  const RenderedImage near_image = near_renderer.render(small_camera(), pose, {});
  pose.translation += far_away;
  const RenderedImage far_image = renderer.render(small_camera(), pose, {});
  // Only the last bits of the doubles differ; single pixels on an edge may.
  const double changed = cv::norm(near_image.rgb, far_image.rgb, cv::NORM_L1);
  EXPECT_LT(changed, 1e-4 * 255 * near_image.rgb.total());
}

// Light enters the image as its power 1 / 2.2, and so do the colours of vertices: in even light a
// white panel shows their bytes, and half way between two corners the mean of theirs. Leaves are
// lit in their vertices, boxes in their pixels.
TEST(RendererTest, ColoursOfVerticesMultiplyTheMaterials) {
  for (const Label label : {Label::kLeaf, Label::kBox}) {
    Scene scene;
    const int material = add_material(scene, label, Eigen::Vector3f::Ones());
    scene.materials[static_cast<std::size_t>(material)].vertex_colours = true;
    Primitive square = panel(material, 1, 1);
    for (Vertex& vertex : square.vertices) {
      vertex.colour = vertex.position.x() < 0 ? std::array<std::uint8_t, 3>{200, 40, 0}
                                              : std::array<std::uint8_t, 3>{100, 40, 255};
    }
    add_instance(scene, add_model(scene, square), {0, 0, 0});
    light_evenly(scene);
    const auto middle = [&] {
      GlRenderer renderer(scene, {});
      return renderer.render(small_camera(), look_at({0, -1, 0}, {0, 0, 0}), {})
          .rgb.at<cv::Vec3b>(240, 376);
    };
    EXPECT_LT(cv::norm(cv::Vec3d(middle()) - cv::Vec3d(150, 40, 127.5)), 2);
    scene.materials[static_cast<std::size_t>(material)].colour = {0.5f, 1, 1};
    // 0.5 to the power 1 / 2.2 is 0.730.
    EXPECT_LT(cv::norm(cv::Vec3d(middle()) - cv::Vec3d(109.5, 40, 127.5)), 2);
    scene.materials[static_cast<std::size_t>(material)].vertex_colours = false;
    EXPECT_LT(cv::norm(cv::Vec3d(middle()) - cv::Vec3d(186, 255, 255)), 2);
  }
}

/// The tag's print, one white module around the black square.
cv::Mat tag_image(const TagFamily& family, int id, int module) {
  cv::Mat large;
  cv::resize(family.image(id), large, {}, module, module, cv::INTER_NEAREST);
  cv::cvtColor(large, large, cv::COLOR_GRAY2RGBA);
  return large;
}

TEST(RendererTest, TagCornersAreWhereTheCameraProjectsThem) {
  constexpr double kSize = 0.161;            // m, the black square of 8 modules
  constexpr double kPanel = kSize * 10 / 8;  // with its white border
  const TagFamily family("tag36h11");
  Scene scene;
  const int material =
      add_material(scene, Label::kTag, Eigen::Vector3f::Constant(0.8f), tag_image(family, 0, 32));
  add_instance(scene, add_model(scene, panel(material, kPanel, kPanel)), {0, 0, 0});
  light_evenly(scene);
  GlRenderer renderer(scene, {});
  const PinholeCamera camera = large_camera();
  // No edge along the pixel grid, where the library's own refinement is off by 0.2 px.
  for (const Pose& pose :
       {look_at({0, -0.6, 0}, {0, 0, 0}, 0.05), look_at({0.3, -0.5, 0.1}, {0, 0, 0}),
        look_at({-0.2, -0.9, -0.1}, {0, 0, 0}, 0.2)}) {
    const std::vector<ReadTag> tags = read_tags(grey_of(renderer.render(camera, pose, {})), family);
    ASSERT_EQ(tags.size(), 1u);
    // The library's order: counter-clockwise in the image from the bottom left.
    const double h = kSize / 2;
    const Eigen::Vector3d expected[] = {{-h, 0, -h}, {h, 0, -h}, {h, 0, h}, {-h, 0, h}};
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector2d pixel = camera.project(pose.inverse() * expected[i]);
      EXPECT_LT((tags[0].corners[static_cast<std::size_t>(i)] - pixel).norm(), 0.1)
          << "corner " << i;
    }
  }
}

/// Mean signed distance, px, of the label's left (or right) border from the projected edge, over
/// the rows: single pixels are quantised to one, their mean over a slanted edge is not.
double edge_offset(const cv::Mat& labels, const Eigen::Vector2d& top, const Eigen::Vector2d& bottom,
                   bool left) {
  double sum = 0;
  int rows = 0;
  for (int v = static_cast<int>(top.y()) + 5; v < static_cast<int>(bottom.y()) - 5; ++v) {
    const double expected =
        top.x() + (bottom.x() - top.x()) * (v - top.y()) / (bottom.y() - top.y());
    const auto* row = labels.ptr<std::uint8_t>(v);
    int first = -1;
    int last = -1;
    for (int u = 0; u < labels.cols; ++u) {
      if (row[u] != static_cast<std::uint8_t>(Label::kPost)) continue;
      if (first < 0) first = u;
      last = u;
    }
    if (first < 0) continue;
    sum += (left ? first - 0.5 : last + 0.5) - expected;
    ++rows;
  }
  EXPECT_GT(rows, 100);
  return sum / rows;
}

TEST(RendererTest, EdgesOfThinPostsAreWhereTheCameraProjectsThem) {
  constexpr double kWidth = 0.07;  // m
  constexpr double kHeight = 1.6;  // m
  Scene scene;
  const int material = add_material(scene, Label::kPost, Eigen::Vector3f::Constant(0.5f));
  add_instance(scene, add_model(scene, panel(material, kWidth, kHeight)), {0, 0, 0});
  light_evenly(scene);
  GlRenderer renderer(scene, {});
  for (const PinholeCamera& camera : {small_camera(), large_camera()}) {
    for (const double roll : {0.05, -0.11}) {
      const Pose pose = look_at({0.4, -1.5, 0.2}, {0.1, 0, 0.05}, roll);
      const cv::Mat labels = renderer.render(camera, pose, {.labels = true}).labels;
      for (const bool left : {true, false}) {
        const double x = (left ? -0.5 : 0.5) * kWidth;
        const Eigen::Vector2d top = camera.project(pose.inverse() * Eigen::Vector3d(x, 0, 0.5));
        const Eigen::Vector2d bottom = camera.project(pose.inverse() * Eigen::Vector3d(x, 0, -0.5));
        EXPECT_NEAR(edge_offset(labels, top, bottom, left), 0, 0.1);
      }
    }
  }
}

class TwoPanelsTest : public testing::Test {
 protected:
  TwoPanelsTest() {
    const int red = add_material(scene_, Label::kBox, {0.8f, 0.1f, 0.1f});
    const int green = add_material(scene_, Label::kLeaf, {0.1f, 0.8f, 0.1f});
    add_instance(scene_, add_model(scene_, panel(red, 4, 1)), {0, 3, 0});
    add_instance(scene_, add_model(scene_, panel(green, 0.5, 3)), {0, 2, 0});
    light_evenly(scene_);
  }
  Scene scene_;
  Pose pose_ = look_at({0, 0, 0}, {0, 1, 0});
};

TEST_F(TwoPanelsTest, LabelsAndDepthAgreeWithGeometry) {
  GlRenderer renderer(scene_, {});
  const PinholeCamera camera = small_camera();
  const RenderedImage image = renderer.render(camera, pose_, {.labels = true, .depth = true});
  ASSERT_EQ(image.rgb.type(), CV_8UC3);
  ASSERT_EQ(image.labels.type(), CV_8UC1);
  ASSERT_EQ(image.depth.type(), CV_32FC1);
  int compared = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      // The ray (x, 1, z) of the world meets the near panel at y = 2, the far one at y = 3.
      const Eigen::Vector3d ray = camera.unproject({u, v});
      const auto within = [&](double y, double half_width, double half_height) {
        return std::abs(ray.x()) * y < half_width && std::abs(ray.y()) * y < half_height;
      };
      const Label label = within(2, 0.25, 1.5) ? Label::kLeaf
                          : within(3, 2, 0.5)  ? Label::kBox
                                               : Label::kSky;
      const float depth = label == Label::kLeaf ? 2.0f : label == Label::kBox ? 3.0f : 0.0f;
      if (image.labels.at<std::uint8_t>(v, u) != static_cast<std::uint8_t>(label)) continue;
      ++compared;
      // 32-bit depth over 0.03 to 200 m resolves 0.02 mm at 3 m.
      ASSERT_NEAR(image.depth.at<float>(v, u), depth, 1e-4) << u << ", " << v;
    }
  }
  // Except pixels whose centre is exactly on an edge.
  EXPECT_GT(compared, 0.999 * camera.width * camera.height);
  const auto middle = image.rgb.at<cv::Vec3b>(240, 376);
  EXPECT_GT(middle[1], middle[0]);
}

TEST_F(TwoPanelsTest, GivesOnlyWhatIsAskedFor) {
  GlRenderer renderer(scene_, {});
  const RenderedImage image = renderer.render(small_camera(), pose_, {});
  EXPECT_TRUE(image.labels.empty());
  EXPECT_TRUE(image.depth.empty());
}

TEST_F(TwoPanelsTest, EvenLightShowsColoursAsTheyAre) {
  GlRenderer renderer(scene_, {});
  const RenderedImage image = renderer.render(small_camera(), pose_, {});
  // Linear 0.8 and 0.1 to the power 1 / 2.2: 230.4 and 89.5 of 255.
  const auto middle = image.rgb.at<cv::Vec3b>(240, 376);
  EXPECT_NEAR(middle[0], 89.5, 1.5);
  EXPECT_NEAR(middle[1], 230.4, 1.5);
  EXPECT_NEAR(middle[2], 89.5, 1.5);
}

TEST_F(TwoPanelsTest, RenderersInTwoThreadsGiveTheSameBytes) {
  const auto draw = [&](std::vector<cv::Mat>& images) {
    GlRenderer renderer(scene_, {});
    for (int i = 0; i < 5; ++i) {
      const Pose pose = look_at({0.1 * i, 0, 0.02 * i}, {0, 1, 0}, 0.01 * i);
      images.push_back(renderer.render(small_camera(), pose, {}).rgb);
      images.push_back(renderer.render(large_camera(), pose, {}).rgb);
    }
  };
  std::vector<cv::Mat> one;
  std::vector<cv::Mat> other;
  std::thread thread([&] { draw(one); });
  draw(other);
  thread.join();
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(cv::norm(one[i], other[i], cv::NORM_INF), 0) << "image " << i;
  }
}

TEST_F(TwoPanelsTest, AnotherThreadMayTakeARendererOver) {
  GlRenderer renderer(scene_, {});
  const cv::Mat here = renderer.render(small_camera(), pose_, {}).rgb;
  cv::Mat there;
  std::thread([&] { there = renderer.render(small_camera(), pose_, {}).rgb; }).join();
  EXPECT_EQ(cv::norm(here, there, cv::NORM_INF), 0);
}

TEST_F(TwoPanelsTest, DistortionIsAnError) {
  GlRenderer renderer(scene_, {});
  PinholeCamera camera = small_camera();
  camera.distortion[0] = -0.1;
  EXPECT_THAT([&] { renderer.render(camera, pose_, {}); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("distortion")));
}

TEST_F(TwoPanelsTest, ASceneThatRefersToNothingIsAnError) {
  scene_.instances[0].model = 7;
  EXPECT_THAT([&] { GlRenderer(scene_, {}); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("instance 0 names model 7")));
}

}  // namespace
}  // namespace vinebench::sim
