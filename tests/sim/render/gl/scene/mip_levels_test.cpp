// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/scene/mip_levels.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "core/util/random.h"

namespace vinebench::sim {
namespace {

/// Alphas drawn at random, that share of them at least one half.
cv::Mat speckled(double share, int side) {
  const RandomStream random(1, "alpha");
  cv::Mat rgba(side, side, CV_8UC4, cv::Scalar(60, 120, 40, 0));
  for (int i = 0; i < side * side; ++i) {
    const double alpha = random.uniform(static_cast<std::uint64_t>(i)) + share - 0.5;
    rgba.at<cv::Vec4b>(i / side, i % side)[3] = cv::saturate_cast<std::uint8_t>(255 * alpha);
  }
  return rgba;
}

TEST(MipLevelsTest, EachHasHalfTheSizeDownToAPixel) {
  const std::vector<cv::Mat> levels =
      mip_levels(cv::Mat(4, 17, CV_8UC4, cv::Scalar::all(9)), false);
  const std::vector<cv::Size> sizes{{17, 4}, {8, 2}, {4, 1}, {2, 1}, {1, 1}};
  ASSERT_EQ(levels.size(), sizes.size());
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    EXPECT_EQ(levels[i].size(), sizes[i]);
    EXPECT_EQ(levels[i].type(), CV_8UC4);
  }
}

TEST(MipLevelsTest, LightIsAveragedAsLight) {
  cv::Mat rgba(2, 2, CV_8UC4, cv::Scalar(0, 255, 255, 255));
  rgba.at<cv::Vec4b>(0, 1) = rgba.at<cv::Vec4b>(1, 0) = {255, 0, 255, 255};
  const cv::Vec4b mean = mip_levels(rgba, false)[1].at<cv::Vec4b>(0, 0);
  // Half of white: 255 * 0.5^(1 / 2.2) = 186.1.
  EXPECT_EQ(mean, cv::Vec4b(186, 186, 255, 255));
}

TEST(MipLevelsTest, TheFinestIsACopy) {
  const cv::Mat rgba = speckled(0.5, 16);
  const cv::Mat finest = mip_levels(rgba, true).front();
  EXPECT_NE(finest.data, rgba.data);
  EXPECT_EQ(cv::norm(finest, rgba, cv::NORM_INF), 0);
}

/// White noise: the mean of four texels has half the deviation of one.
TEST(MipLevelsTest, GroundKeepsItsContrastAtEveryDistance) {
  const RandomStream random(1, "noise");
  cv::Mat rgba(256, 256, CV_8UC4, cv::Scalar(128, 128, 128, 255));
  for (int i = 0; i < 256 * 256; ++i) {
    // From 164 to 206, a light of 0.38 to 0.63: two such levels are raised without clipping.
    const double code = 164 + 42 * random.uniform(static_cast<std::uint64_t>(i));
    rgba.at<cv::Vec4b>(i / 256, i % 256)[1] = static_cast<std::uint8_t>(code);
  }
  const std::vector<cv::Mat> plain = mip_levels(rgba, false), rough = rough_mip_levels(rgba);
  const double finest = near_contrast(rgba);
  EXPECT_EQ(cv::norm(rough[0], rgba, cv::NORM_INF), 0);
  EXPECT_NEAR(near_contrast(plain[1]) / finest, 0.5, 0.03);
  EXPECT_NEAR(near_contrast(rough[1]) / finest, kKeptContrast, 0.04);
  // An eighth is raised by as much as is allowed. What differs from its neighbourhood differs from
  // that of the raised image too, h = 1 - b twice: with the 3 x 3 mean b, white noise has 8/9 of
  // its power in h, 0.933 in h^3 and 1.008 in h^4. Bytes round a deviation of 1.5 of them.
  const double f = kMostRaised - 1;
  const double gain = std::sqrt(1 + (2 * f * 0.933 + f * f * 1.008) / (8.0 / 9));
  EXPECT_NEAR(near_contrast(rough[3]) / near_contrast(plain[3]), gain, 0.05 * gain);
  // What an even ground has is its light.
  EXPECT_NEAR(cv::mean(rough[3])[1], cv::mean(plain[3])[1], 1.5);
}

TEST(MipLevelsTest, ACutOutKeepsItsCoverage) {
  for (const double share : {0.2, 0.6}) {
    const cv::Mat rgba = speckled(share, 64);
    const double coverage = alpha_coverage(rgba);
    const std::vector<cv::Mat> levels = mip_levels(rgba, true);
    for (std::size_t i = 1; levels[i].cols >= 8; ++i) {
      // Means of 64 texels are within some 6 % of each other: what a rounded byte lets pass is up
      // to 8 % of them.
      EXPECT_NEAR(alpha_coverage(levels[i]), coverage, 0.1) << share << " " << i;
    }
    // Without it, the mean passes everywhere or nowhere.
    EXPECT_EQ(alpha_coverage(mip_levels(rgba, false)[4]), share > 0.5 ? 1 : 0);
  }
}

TEST(MipLevelsTest, ACutOutsBackgroundDoesNotBleed) {
  cv::Mat rgba(2, 2, CV_8UC4, cv::Scalar(0, 255, 0, 0));
  rgba.at<cv::Vec4b>(0, 0) = {200, 0, 0, 255};
  const cv::Vec4b mean = mip_levels(rgba, true)[1].at<cv::Vec4b>(0, 0);
  // The background counts a thousandth each: green of (3 / 1003)^(1 / 2.2) is 18 of 255.
  EXPECT_NEAR(mean[0], 200, 2);
  EXPECT_LT(mean[1], 20);
}

TEST(MipLevelsTest, CoverageIsTheShareOfAlphasOfAtLeastAHalf) {
  cv::Mat rgba(1, 4, CV_8UC4, cv::Scalar::all(255));
  rgba.at<cv::Vec4b>(0, 1)[3] = 128;
  rgba.at<cv::Vec4b>(0, 2)[3] = 127;
  rgba.at<cv::Vec4b>(0, 3)[3] = 0;
  EXPECT_EQ(alpha_coverage(rgba), 0.5);
}

}  // namespace
}  // namespace vinebench::sim
