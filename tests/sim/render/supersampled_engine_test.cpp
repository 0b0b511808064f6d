// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/supersampled_engine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "sim/render/factory/make_render_engine.h"
#include "sim/render/image_encoding.h"
#include "tests/support/chessboard.h"
#include "tests/support/effect_camera.h"
#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

constexpr PinholeCamera kCamera{160, 120, 100, 110, 78.25, 61, {}};

std::unique_ptr<RenderEngine> engine_for(const Scene& scene, int supersampling) {
  RendererConfig config;
  config.shadow_map_size = 0;
  config.supersampling = supersampling;
  return make_render_engine(scene, config);
}

/// Sum of an image's light, in white pixels.
double sum_of_light(const cv::Mat& codes) {
  return cv::sum(to_light(codes))[1];
}

/// Pixels of neither of the two brightnesses of even panels before an even sky.
int between(const cv::Mat& image, int dark, int bright) {
  const cv::Mat green = test::channel(image, 1);
  return cv::countNonZero((green > dark) & (green < bright));
}

/// A white panel of 0.8 m by 0.6 m, turned in the image, in front of a black one.
class WhitePanel : public testing::Test {
 protected:
  WhitePanel() {
    const int white = test::add_material(scene_, Label::kBox, Eigen::Vector3f::Ones());
    const int black = test::add_material(scene_, Label::kPost, Eigen::Vector3f::Zero());
    test::add_instance(scene_, test::add_model(scene_, test::panel(white, 0.8, 0.6)), {0, 0, 0});
    test::add_instance(scene_, test::add_model(scene_, test::panel(black, 20, 20)), {0, 0.01, 0});
    test::light_evenly(scene_);
  }
  RenderedImage drawn(int supersampling, const RenderRequest& request = {}) const {
    return engine_for(scene_, supersampling)->render(kCamera, view_, request);
  }
  Scene scene_;
  Pose view_ = test::look_at({0, -1.5, 0}, {0, 0, 0}, 0.3);
};

/// The image's borders and so each pixel's square stay: pixel -0.5 is -0.5 of the large one.
TEST(EnlargedTest, TheViewStays) {
  const PinholeCamera large = enlarged(kCamera, 3);
  EXPECT_EQ(large.width, 480);
  EXPECT_EQ(large.height, 360);
  for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(-0.5, -0.5), Eigen::Vector2d(159.5, 40)}) {
    const Eigen::Vector2d there =
        3 * (pixel + Eigen::Vector2d(0.5, 0.5)) - Eigen::Vector2d(0.5, 0.5);
    EXPECT_NEAR((large.project(kCamera.unproject(pixel)) - there).norm(), 0, 1e-9);
  }
}

/// One white pixel of four is light of 0.25: 255 * 0.25^(1 / 2.2) = 135.8; of even squares the
/// code stays.
TEST(MeanOfSquaresTest, IsOfLight) {
  cv::Mat codes(2, 4, CV_8UC3, cv::Scalar(0, 0, 0));
  codes.at<cv::Vec3b>(1, 0) = {255, 0, 255};
  codes.colRange(2, 4).setTo(cv::Scalar(1, 90, 254));
  const cv::Mat mean = mean_of_squares(codes, 2);
  ASSERT_EQ(mean.size(), cv::Size(2, 1));
  EXPECT_EQ(mean.at<cv::Vec3b>(0, 0), cv::Vec3b(136, 0, 136));
  EXPECT_EQ(mean.at<cv::Vec3b>(0, 1), cv::Vec3b(1, 90, 254));
}

/// The panel covers 0.8 * 100 / 1.5 = 53.3 by 0.6 * 110 / 1.5 = 44 pixels (turned, in pixels that
/// are not square: the same area), 2347 white ones. Of the 200 pixels on its sides each sample
/// decides by its centre, an error of uniform 1 / sqrt(12) = 0.29 pixels: sqrt(200) * 0.29 = 4.1,
/// with 2 * 2 samples of a quarter of a pixel on twice as long sides 1.5. Four deviations.
TEST_F(WhitePanel, TheLightIsThatOfThePlainImage) {
  const double area = 0.8 * 100 / 1.5 * (0.6 * 110 / 1.5);
  EXPECT_NEAR(sum_of_light(drawn(1).rgb), area, 4 * 4.1);
  EXPECT_NEAR(sum_of_light(drawn(2).rgb), area, 4 * 1.5);
}

/// A pixel is between where a side parts its samples, which fill a square of (n - 1) / n pixels a
/// side. A line of 195 pixels, turned by 0.3 rad, crosses 195 (n - 1) / n (cos 0.3 + sin 0.3) of
/// these, give or take two at each of the sides' eight ends.
TEST_F(WhitePanel, EdgesHaveStepsBetween) {
  const double crossed = 195 * (std::cos(0.3) + std::sin(0.3));
  EXPECT_EQ(between(drawn(1).rgb, 0, 255), 0);
  EXPECT_NEAR(between(drawn(2).rgb, 0, 255), crossed / 2, 16);
  EXPECT_NEAR(between(drawn(4).rgb, 0, 255), crossed * 3 / 4, 16);
}

TEST_F(WhitePanel, TheTruthIsThatOfThePlainImageToTheByte) {
  RenderRequest request = truth_request();
  request.instances = true;
  scene_.wind.speed = 2;  // m/s: without any, no image of motion is drawn
  const RenderedImage plain = drawn(1, request);
  const RenderedImage fine = drawn(2, request);
  EXPECT_GT(test::different_values(fine.rgb, plain.rgb), 0);
  for (const auto layer : {&RenderedImage::labels, &RenderedImage::depth, &RenderedImage::instances,
                           &RenderedImage::normals, &RenderedImage::motion}) {
    ASSERT_FALSE((fine.*layer).empty());
    EXPECT_EQ(test::different_values(fine.*layer, plain.*layer), 0);
  }
  EXPECT_TRUE(drawn(2).labels.empty());
}

/// A near level up to 6 m at a focal length of 1100 px is one up to 0.6 m at 110 px; with twice
/// the pixels it would be one up to 1.2 m and be seen from 1 m.
TEST_F(WhitePanel, ColoursAreOfTheSameLevelOfDetailAsTheTruth) {
  Model& model = scene_.models[0];
  model.levels.push_back(model.levels[0]);
  model.levels[0].until = 6;
  model.levels[0].primitives = {test::panel(model.levels[1].primitives[0].material, 0.1, 0.1)};
  view_ = test::look_at({0, -1, 0}, {0, 0, 0}, 0.3);
  RenderRequest request;
  request.labels = true;
  const RenderedImage fine = drawn(2, request);
  const double area = 0.8 * 100 / 1 * (0.6 * 110 / 1);
  const double labelled = cv::countNonZero(fine.labels == static_cast<int>(Label::kBox));
  EXPECT_NEAR(labelled, area, 0.02 * area);
  EXPECT_NEAR(sum_of_light(fine.rgb), area, 0.02 * area);
}

TEST(SupersampledEngineTest, CornersAreWhereTheCameraProjectsThem) {
  const Scene scene = test::Chessboard::scene();
  const PinholeCamera camera{700, 500, 300, 330, 310.25, 270.5, {}};
  const Pose view = test::look_at({0.1, -0.5, 0.1}, {0, 0, 0});
  const auto engine = engine_for(scene, 2);
  const cv::Mat image = engine->render(camera, view, {}).rgb;
  // As for the plain image: a tenth of a feature's accuracy.
  EXPECT_LT(test::Chessboard::worst_corner(image, camera, view), 0.1);
}

TEST(SupersampledEngineTest, ACameraOfNoUseIsAnError) {
  const Scene scene = test::Chessboard::scene();
  const auto engine = engine_for(scene, 2);
  EXPECT_NE(test::error_of([&] { engine->render({}, {}, {}); }), "");
}

}  // namespace
}  // namespace vinebench::sim
