// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/fake/fake_renderer.h"

#include <gtest/gtest.h>

#include "core/util/error.h"
#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

/// A camera 1 m above the court's middle that looks level along x: row y sees down by
/// (y - 40) / 100, column x to the right by (x - 60) / 100.
class FakeRendererTest : public testing::Test {
 protected:
  RenderedImage render(const RenderRequest& request, const Eigen::Vector3d& at = {0, 0, 1}) {
    FakeRenderer renderer(scene_);
    return renderer.render(camera_, test::look_at(at, at + Eigen::Vector3d::UnitX()), request);
  }
  static void expect_label(const RenderedImage& image, int x, int y, Label label) {
    EXPECT_EQ(image.labels.at<std::uint8_t>(y, x), static_cast<std::uint8_t>(label))
        << x << " " << y;
  }

  PinholeCamera camera_{121, 81, 100, 100, 60, 40, {}};
  Scene scene_;
};

TEST_F(FakeRendererTest, GroundWallAndSkyMeetWhereGeometryHasThem) {
  const RenderedImage image = render(truth_request());
  // The wall at 30 m spans heights of 0 to 3 m: 3.3 px below the horizon to 6.7 px above it.
  expect_label(image, 60, 44, Label::kGround);
  expect_label(image, 60, 43, Label::kPost);
  expect_label(image, 60, 34, Label::kPost);
  expect_label(image, 60, 33, Label::kSky);
}

TEST_F(FakeRendererTest, DepthIsAlongTheOpticalAxis) {
  const RenderedImage image = render(truth_request());
  EXPECT_NEAR(image.depth.at<float>(60, 10), 1 / 0.2, 1e-5);  // 20 px down: 1 m below at 5 m
  EXPECT_NEAR(image.depth.at<float>(38, 0), 30, 1e-4);
  EXPECT_NEAR(image.depth.at<float>(38, 120), 30, 1e-4);
  EXPECT_EQ(image.depth.at<float>(0, 60), 0);
}

TEST_F(FakeRendererTest, NormalsPointTowardsTheCamera) {
  const RenderedImage image = render(truth_request());
  EXPECT_LT(cv::norm(image.normals.at<cv::Vec3f>(60, 10) - cv::Vec3f(0, -1, 0)), 1e-6);
  EXPECT_LT(cv::norm(image.normals.at<cv::Vec3f>(38, 60) - cv::Vec3f(0, 0, -1)), 1e-6);
  EXPECT_EQ(cv::norm(image.normals.at<cv::Vec3f>(0, 60)), 0);
  EXPECT_EQ(cv::countNonZero(image.motion.reshape(1)), 0);
}

TEST_F(FakeRendererTest, StandsForTheScenesFirstInstances) {
  const auto ids = [&] {
    const cv::Mat image = render(truth_request()).instances;
    return std::array{image.at<int>(60, 10), image.at<int>(38, 60), image.at<int>(0, 60)};
  };
  EXPECT_EQ(ids(), (std::array{0, 0, 0}));
  scene_.instances.resize(1);
  EXPECT_EQ(ids(), (std::array{256, 0, 0}));
  scene_.instances.resize(3);
  EXPECT_EQ(ids(), (std::array{256, 512, 0}));
}

TEST_F(FakeRendererTest, OutsideTheCourtThereIsNoWall) {
  const RenderedImage image = render(truth_request(), {31, 0, 1});
  expect_label(image, 60, 38, Label::kSky);
  expect_label(image, 60, 60, Label::kGround);
}

TEST_F(FakeRendererTest, ThePatternIsFixedToTheSurfaces) {
  // Moved by 0.5 m ahead, the ground at 2 m is at 1.5 m: rows 40 + 50 and 40 + 66.7.
  camera_ = {121, 121, 100, 100, 60, 40, {}};
  const cv::Mat before = render({}).rgb, after = render({}, {0.5, 0, 1}).rgb;
  int same = 0, dark = 0;
  for (int i = -16; i <= 16; ++i) {
    // The centres of squares of 5 cm along y, at x = 2.025 m.
    const double y = 0.025 + 0.05 * i;
    const auto at = [&](const cv::Mat& image, double ahead) {
      return image.at<cv::Vec3b>(static_cast<int>(std::lround(40 + 100 / ahead)),
                                 static_cast<int>(std::lround(60 - 100 * y / ahead)))[0];
    };
    same += at(before, 2.025) == at(after, 1.525);
    dark += at(before, 2.025) < 150;
  }
  // A row is 4 cm of ground there: half a pixel off is still inside the square.
  EXPECT_EQ(same, 33);
  // Shades 0 to 2 of 8 are below 150 = 255 * 0.31^(1 / 2.2): the squares are not all alike.
  EXPECT_GT(dark, 3);
  EXPECT_LT(dark, 27);
}

TEST_F(FakeRendererTest, ExposureMultipliesTheLight) {
  RenderRequest request;
  // The sky has 0.75 of light: 255 * 0.75^(1 / 2.2) = 223.7, half of it 163.3, double saturates.
  EXPECT_EQ(render(request).rgb.at<cv::Vec3b>(0, 60), cv::Vec3b::all(224));
  request.exposure = 0.5;
  EXPECT_EQ(render(request).rgb.at<cv::Vec3b>(0, 60), cv::Vec3b::all(163));
  request.exposure = 2;
  EXPECT_EQ(render(request).rgb.at<cv::Vec3b>(0, 60), cv::Vec3b::all(255));
}

TEST_F(FakeRendererTest, GivesOnlyWhatIsAskedFor) {
  const RenderedImage image = render({});
  EXPECT_FALSE(image.rgb.empty());
  EXPECT_TRUE(image.labels.empty() && image.depth.empty() && image.instances.empty() &&
              image.normals.empty() && image.motion.empty());
  camera_.distortion[0] = 0.1;
  EXPECT_THROW(render({}), Error);
}

}  // namespace
}  // namespace vinebench::sim
