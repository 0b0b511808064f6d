// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/textures/textures.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace vinebench::sim {
namespace {

/// The stream's numbers, row by row, as floats.
cv::Mat drawn(cv::Size cells, const RandomStream& random) {
  cv::Mat grid(cells, CV_32F);
  for (int i = 0; i < cells.area(); ++i) {
    grid.at<float>(i / cells.width, i % cells.width) = static_cast<float>(random.uniform(i));
  }
  return grid;
}

TEST(FractalNoiseTest, WithACellAPixelItIsTheStreamScaled) {
  cv::Mat expected = drawn({3, 2}, RandomStream(7, "noise", 0));
  cv::normalize(expected, expected, 0, 1, cv::NORM_MINMAX);
  const cv::Mat noise = fractal_noise({3, 2}, {3, 2}, 1, 0.5, 7, "noise");
  EXPECT_EQ(cv::norm(noise, expected, cv::NORM_INF), 0);
}

TEST(FractalNoiseTest, InterpolatesAsOpenCvDoes) {
  // Three by three tiles of the grid, enlarged: the middle one is far from any border.
  const cv::Mat grid = drawn({5, 3}, RandomStream(7, "noise", 0));
  cv::Mat expected;
  cv::resize(cv::repeat(grid, 3, 3), expected, {3 * 40, 3 * 48}, 0, 0, cv::INTER_CUBIC);
  expected = expected(cv::Rect(40, 48, 40, 48)).clone();
  cv::normalize(expected, expected, 0, 1, cv::NORM_MINMAX);
  const cv::Mat noise = fractal_noise({40, 48}, {5, 3}, 1, 0.5, 7, "noise");
  // Places in the grid, 15 cells at most, are rounded to 1e-6 of a cell, over which a value changes
  // by less than 5 times that.
  EXPECT_LT(cv::norm(noise, expected, cv::NORM_INF), 5e-5);
}

// Without a seam, neighbours across the edge differ no more than neighbours within.
TEST(FractalNoiseTest, RepeatsWithoutASeamAndFillsItsRange) {
  const cv::Mat noise = fractal_noise({64, 64}, {4, 4}, 3, 0.5, 3, "noise");
  double least = 0, most = 0;
  cv::minMaxLoc(noise, &least, &most);
  EXPECT_NEAR(least, 0, 1e-6);
  EXPECT_NEAR(most, 1, 1e-6);
  float within = 0, across = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x + 1 < 64; ++x) {
      within = std::max(within, std::abs(noise.at<float>(y, x + 1) - noise.at<float>(y, x)));
    }
    across = std::max(across, std::abs(noise.at<float>(y, 0) - noise.at<float>(y, 63)));
  }
  EXPECT_LE(across, 1.5f * within);
}

TEST(BlendTest, GoesFromLowToHigh) {
  const cv::Mat amount = (cv::Mat_<float>(1, 3) << 0, 0.25f, 1);
  const cv::Mat rgb = blend(amount, {10, 20, 30}, {50, 20, 10});
  EXPECT_EQ(rgb.at<cv::Vec3f>(0, 0), cv::Vec3f(10, 20, 30));
  EXPECT_EQ(rgb.at<cv::Vec3f>(0, 1), cv::Vec3f(20, 20, 25));
  EXPECT_EQ(rgb.at<cv::Vec3f>(0, 2), cv::Vec3f(50, 20, 10));
  const cv::Mat other(1, 3, CV_32FC3, cv::Scalar(100, 100, 100));
  EXPECT_EQ(mix(amount, rgb, other).at<cv::Vec3f>(0, 0), cv::Vec3f(10, 20, 30));
  EXPECT_EQ(mix(amount, rgb, other).at<cv::Vec3f>(0, 1), cv::Vec3f(40, 40, 43.75f));
  EXPECT_EQ(rgb.at<cv::Vec3f>(0, 1), cv::Vec3f(20, 20, 25));  // kept
  EXPECT_EQ(mix(amount, rgb.clone(), cv::Vec3f(100, 100, 100)).at<cv::Vec3f>(0, 1),
            cv::Vec3f(40, 40, 43.75f));
}

TEST(RgbaTest, IsOpaqueUnlessItHasAnAlpha) {
  const cv::Mat rgb(1, 2, CV_32FC3, cv::Scalar(300, 100, -5));
  EXPECT_EQ(to_rgba(rgb).at<cv::Vec4b>(0, 0), cv::Vec4b(255, 100, 0, 255));  // saturates
  const cv::Mat alpha(1, 2, CV_8UC1, cv::Scalar(77));
  EXPECT_EQ(to_rgba(rgb, alpha).at<cv::Vec4b>(0, 1), cv::Vec4b(255, 100, 0, 77));
}

}  // namespace
}  // namespace vinebench::sim
