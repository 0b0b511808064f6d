// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/plants/plant_painter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

namespace vinebench::sim {
namespace {

/// A window of 1 m x 1 m on the plane y = 0, seen from -y, of 8 x 8 pixels. Materials: 0 white, 1 a
/// texture of even red, 2 one of even grey.
class PlantPainterTest : public testing::Test {
 protected:
  PlantPainterTest() {
    materials_.resize(3);
    textures_ = {{"red", cv::Mat(8, 8, CV_8UC4, cv::Scalar(200, 50, 20, 255)), true},
                 {"grey", cv::Mat(8, 8, CV_8UC4, cv::Scalar(100, 100, 100, 255)), true}};
    materials_[1].texture = 0;
    materials_[2].texture = 1;
  }

  /// An upright rectangle at y that faces the viewer.
  static Primitive sheet(int material, const Eigen::Vector2f& from, const Eigen::Vector2f& to,
                         float y = 0, float occlusion = 1) {
    const Eigen::Vector3f normal(0, -1, 0);
    Primitive part;
    part.material = material;
    part.vertices = {{{from.x(), y, from.y()}, normal, {0, 1}, occlusion},
                     {{to.x(), y, from.y()}, normal, {1, 1}, occlusion},
                     {{to.x(), y, to.y()}, normal, {1, 0}, occlusion},
                     {{from.x(), y, to.y()}, normal, {0, 0}, occlusion}};
    part.indices = {0, 1, 2, 0, 2, 3};
    return part;
  }
  PlantPainting paint(const std::vector<Primitive>& parts) const {
    return paint_plant(parts, textures_, materials_,
                       {{1, 0, 0}, {0, -1, 0}, {0, 0}, {1, 1}, {8, 8}});
  }
  /// Colours come back from linear light within a rounding.
  static void expect_colour(const cv::Vec4b& pixel, const cv::Vec3d& colour, int alpha) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c], colour[c], 0.6) << c;
    EXPECT_EQ(pixel[3], alpha);
  }

  std::vector<Texture> textures_;
  std::vector<Material> materials_;
};

TEST_F(PlantPainterTest, TheImagesTopIsUpAndItsRightIsRight) {
  const PlantPainting painting = paint({sheet(1, {0, 0.5f}, {0.5f, 1})});
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      const bool inside = x < 4 && y < 4;
      // Empty pixels have the mean colour, so that mip levels do not darken the rim.
      expect_colour(painting.rgba.at<cv::Vec4b>(y, x), {200, 50, 20}, inside ? 255 : 0);
      EXPECT_EQ(std::isnan(painting.depth.at<float>(y, x)), !inside) << x << " " << y;
    }
  }
}

TEST_F(PlantPainterTest, AlphaIsTheShareThatIsCovered) {
  // Up to x = 1/3 of pixel 4: one of three columns of samples.
  const PlantPainting painting = paint({sheet(1, {0, 0}, {(4 + 0.34f) / 8, 1})});
  EXPECT_EQ(painting.rgba.at<cv::Vec4b>(3, 3)[3], 255);
  EXPECT_EQ(painting.rgba.at<cv::Vec4b>(3, 4)[3], 255 / 3);
  EXPECT_EQ(painting.rgba.at<cv::Vec4b>(3, 5)[3], 0);
}

TEST_F(PlantPainterTest, TheNearerSheetHidesTheOther) {
  const Primitive near = sheet(1, {0, 0}, {1, 1}, -0.3f), far = sheet(0, {0, 0}, {1, 1}, 0.2f);
  for (const PlantPainting& painting : {paint({near, far}), paint({far, near})}) {
    expect_colour(painting.rgba.at<cv::Vec4b>(2, 5), {200, 50, 20}, 255);
    EXPECT_NEAR(painting.depth.at<float>(2, 5), 0.3, 1e-6);  // along -y
  }
}

TEST_F(PlantPainterTest, WithoutATextureItIsWhite) {
  expect_colour(paint({sheet(0, {0, 0}, {1, 1})}).rgba.at<cv::Vec4b>(4, 4), {255, 255, 255}, 255);
}

TEST_F(PlantPainterTest, LightIsRelativeToItsMean) {
  const PlantPainting painting =
      paint({sheet(2, {0, 0}, {0.5f, 1}, 0, 1), sheet(2, {0.5f, 0}, {1, 1}, 0, 0.5f)});
  EXPECT_NEAR(painting.occlusion, 0.75, 1e-5);
  // 1 and 0.5 about a mean of 0.75, as light: codes of 100 (4/3)^(1/2.2) and 100 (2/3)^(1/2.2).
  expect_colour(painting.rgba.at<cv::Vec4b>(4, 1), cv::Vec3d::all(113.97), 255);
  expect_colour(painting.rgba.at<cv::Vec4b>(4, 6), cv::Vec3d::all(83.17), 255);
}

TEST_F(PlantPainterTest, BothSidesOfABladeAreLit) {
  Primitive away = sheet(2, {0.5f, 0}, {1, 1});
  for (Vertex& v : away.vertices) v.normal = -v.normal;
  const PlantPainting painting = paint({sheet(2, {0, 0}, {0.5f, 1}), away});
  expect_colour(painting.rgba.at<cv::Vec4b>(4, 1), cv::Vec3d::all(100), 255);
  expect_colour(painting.rgba.at<cv::Vec4b>(4, 6), cv::Vec3d::all(100), 255);
}

TEST_F(PlantPainterTest, ABladeThatFacesTheSkyIsBrighterThanOneThatFacesTheGround) {
  Primitive up = sheet(2, {0, 0}, {0.5f, 1}), down = sheet(2, {0.5f, 0}, {1, 1});
  for (Vertex& v : up.vertices) v.normal = Eigen::Vector3f(0, -1, 1).normalized();
  for (Vertex& v : down.vertices) v.normal = Eigen::Vector3f(0, -1, -1).normalized();
  const PlantPainting painting = paint({up, down});
  EXPECT_GT(painting.rgba.at<cv::Vec4b>(4, 1)[0], 100);
  EXPECT_LT(painting.rgba.at<cv::Vec4b>(4, 6)[0], 100);
}

TEST_F(PlantPainterTest, NothingIsTransparent) {
  const PlantPainting painting = paint({});
  EXPECT_EQ(cv::countNonZero(painting.rgba.reshape(1)), 0);
  EXPECT_TRUE(std::isnan(painting.depth.at<float>(0, 0)));
  EXPECT_EQ(painting.occlusion, 1);
}

}  // namespace
}  // namespace vinebench::sim
