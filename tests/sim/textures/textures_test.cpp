// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/textures/textures.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace vinebench::sim {
namespace {

TEST(ValueNoiseTest, WithACellAPixelItIsTheStream) {
  const RandomStream random(7, "noise");
  const cv::Mat noise = value_noise({3, 2}, {3, 2}, random);
  EXPECT_EQ(noise.at<float>(1, 2), static_cast<float>(random.uniform(5)));  // row by row
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
}

TEST(RgbaTest, IsOpaqueUnlessItHasAnAlpha) {
  const cv::Mat rgb(1, 2, CV_32FC3, cv::Scalar(300, 100, -5));
  EXPECT_EQ(to_rgba(rgb).at<cv::Vec4b>(0, 0), cv::Vec4b(255, 100, 0, 255));  // saturates
  const cv::Mat alpha(1, 2, CV_8UC1, cv::Scalar(77));
  EXPECT_EQ(to_rgba(rgb, alpha).at<cv::Vec4b>(0, 1), cv::Vec4b(255, 100, 0, 77));
}

}  // namespace
}  // namespace vinebench::sim
