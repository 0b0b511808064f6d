// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/camera/lens.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "tests/support/test_folder.h"
#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

using testing::HasSubstr;

PinholeCamera lens(double k1, double k2 = 0, double p1 = 0, double p2 = 0) {
  PinholeCamera camera = test::small_camera();
  camera.distortion = {k1, k2, p1, p2};
  return camera;
}

/// An image of a view whose values are the pixels' x or y.
cv::Mat ramp(const PinholeCamera& view, int axis) {
  cv::Mat image(view.height, view.width, CV_32FC1);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      image.at<float>(y, x) = static_cast<float>(axis == 0 ? x : y);
    }
  }
  return image;
}

TEST(LensTest, WithoutDistortionABandIsTheRowsThemselves) {
  const PinholeCamera camera{20, 10, 15, 16, 9.5, 4.5, {}};
  const std::vector<LensBand> bands = make_lens_bands(camera, 3);
  ASSERT_EQ(bands.size(), 3u);
  int next = 0;
  for (const LensBand& band : bands) {
    EXPECT_EQ(band.top, next);
    next += band.rows;
    EXPECT_EQ(band.view.width, 20);
    EXPECT_EQ(band.view.height, band.rows);
    // A ray of the camera's row y is in the band's row y - top.
    EXPECT_EQ(band.view.cy, 4.5 - band.top);
    EXPECT_EQ(band.view.cx, 9.5);
    const cv::Mat image = ramp(band.view, 0);
    EXPECT_EQ(band.resample(image, false).data, image.data);
  }
  EXPECT_EQ(next, 10);
}

TEST(LensTest, ThereAreAtMostAsManyBandsAsRows) {
  const PinholeCamera camera{20, 10, 15, 15, 9.5, 4.5, {}};
  EXPECT_EQ(make_lens_bands(camera, 0).size(), 1u);
  EXPECT_EQ(make_lens_bands(camera, 99).size(), 10u);
}

/// Resampled, a ramp says where each pixel came from. OpenCV's bicubic kernel of a = -0.75 bends a
/// ramp by (2 a + 1) t (1 - t) (1 - 2 t), up to 0.048 px; places are rounded to 1/32 px.
TEST(LensTest, EachPixelIsTakenFromWhereItsRayMeetsTheView) {
  const PinholeCamera camera = lens(-0.12, 0.02, 0.001, -0.002);
  for (const LensBand& band : make_lens_bands(camera, 3)) {
    const cv::Mat xs = band.resample(ramp(band.view, 0), false);
    const cv::Mat ys = band.resample(ramp(band.view, 1), false);
    ASSERT_EQ(xs.size(), cv::Size(camera.width, band.rows));
    for (int y = 0; y < band.rows; y += 13) {
      for (int x = 0; x < camera.width; x += 17) {
        const Eigen::Vector3d ray = camera.unproject({x, band.top + y});
        const Eigen::Vector2d place = band.view.project(ray);
        EXPECT_TRUE(band.view.contains(place, 1));
        EXPECT_NEAR(xs.at<float>(y, x), place.x(), 0.07) << x << " " << band.top + y;
        EXPECT_NEAR(ys.at<float>(y, x), place.y(), 0.07) << x << " " << band.top + y;
      }
    }
  }
}

TEST(LensTest, NearestTakesAWholePixel) {
  const PinholeCamera camera = lens(-0.12, 0.02);
  const LensBand band = make_lens_bands(camera, 1).front();
  const cv::Mat xs = band.resample(ramp(band.view, 0), true);
  for (int y = 0; y < camera.height; y += 13) {
    for (int x = 0; x < camera.width; x += 17) {
      const double place = band.view.project(camera.unproject({x, y})).x();
      EXPECT_EQ(xs.at<float>(y, x), std::round(xs.at<float>(y, x)));
      EXPECT_NEAR(xs.at<float>(y, x), place, 0.501) << x << " " << y;
    }
  }
}

TEST(LensTest, TheViewCoversTheImageAndKeepsItsDetail) {
  for (const PinholeCamera& camera : {lens(-0.1, 0.01), lens(0.05)}) {
    const PinholeCamera view = make_lens_bands(camera, 1).front().view;
    EXPECT_FALSE(view.has_distortion());
    EXPECT_GE(view.fx, camera.fx);
    EXPECT_LE(view.fx, 1.5 * camera.fx);
    for (const Eigen::Vector2d& corner :
         {Eigen::Vector2d(0, 0), {751, 0}, {0, 479}, {751, 479}, {375, 0}, {0, 240}}) {
      EXPECT_TRUE(view.contains(view.project(camera.unproject(corner)), 1));
    }
  }
}

TEST(LensTest, ALensThatMagnifiesIsDrawnFiner) {
  // Pixels of x (1 + 0.12 r^2) are 1 + 0.12 r^2 + 0.24 x^2 apart: in the corner, where x = 1.16 and
  // r = 1.38, 1.55 times, of which 1.5 is the most.
  EXPECT_NEAR(make_lens_bands(lens(0.12), 1).front().view.fx, 1.5 * 263.2786, 1e-9);
  // One that makes smaller is drawn as its middle is.
  EXPECT_NEAR(make_lens_bands(lens(-0.03), 1).front().view.fx, 263.2786, 0.01);
}

TEST(LensTest, ALensThatFoldsOverIsRefused) {
  const auto error = [](double k1) {
    return test::error_of([&] { make_lens_bands(lens(k1), 1); });
  };
  EXPECT_THAT(error(-0.5), HasSubstr("folds over at pixel"));
  EXPECT_THAT(error(std::nan("")), HasSubstr("folds over at pixel"));
}

TEST(LensTest, AViewTooLargeIsRefused) {
  // x (1 - 0.01 x^2) = 0.5 at 0.5013: 0.25 % wider than 8190 pixels.
  const PinholeCamera camera{8190, 2, 8190, 8190, 4094.5, 0.5, {-0.01, 0, 0, 0}};
  EXPECT_THAT(test::error_of([&] { make_lens_bands(camera, 1); }), HasSubstr("requires a view of"));
}

}  // namespace
}  // namespace vinebench::sim
