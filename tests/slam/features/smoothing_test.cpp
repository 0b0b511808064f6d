// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/features/smoothing.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/support/synthetic_texture.h"

namespace vinebench::slam {
namespace {

using test::render_image;
using test::SyntheticTexture;

double worst(const cv::Mat& a, const cv::Mat& b) {
  return cv::norm(a, b, cv::NORM_INF);
}

TEST(Smoothing, IsAGaussianOfTwoPixels) {
  const cv::Mat image = render_image(201, 97, SyntheticTexture(4), 2, 1);
  cv::Mat expected;
  cv::GaussianBlur(image, expected, cv::Size(7, 7), 2, 2, cv::BORDER_REFLECT_101);
  // Weights to 1/128 in each direction, and rounding.
  EXPECT_LE(worst(smooth(image), expected), 2);
}

TEST(Smoothing, KeepsWhatIsFlat) {
  for (const int grey : {0, 1, 127, 255}) {
    const cv::Mat flat(20, 30, CV_8UC1, cv::Scalar(grey));
    EXPECT_EQ(worst(smooth(flat), flat), 0) << grey;
  }
}

TEST(Smoothing, SpreadsAPointByTheWeights) {
  cv::Mat point = cv::Mat::zeros(15, 15, CV_8UC1);
  point.at<std::uint8_t>(7, 7) = 255;
  const cv::Mat smoothed = smooth(point);
  // 255 * 28/128 * 28/128 = 12.2; beside it 24/128, at the corner (9/128)^2: 1.26.
  EXPECT_EQ(smoothed.at<std::uint8_t>(7, 7), 12);
  EXPECT_EQ(smoothed.at<std::uint8_t>(7, 8), 10);
  EXPECT_EQ(smoothed.at<std::uint8_t>(8, 7), 10);
  EXPECT_EQ(smoothed.at<std::uint8_t>(4, 10), 1);
  EXPECT_EQ(smoothed.at<std::uint8_t>(7, 11), 0);
}

TEST(Smoothing, AnyPitchAndAnySizeWillDo) {
  const cv::Mat image = render_image(64, 40, SyntheticTexture(9));
  const cv::Mat part = image(cv::Rect(10, 10, 33, 21));
  EXPECT_EQ(worst(smooth(part), smooth(part.clone())), 0);
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(1, 9), cv::Size(2, 2), cv::Size(9, 1)}) {
    const cv::Mat tiny(size, CV_8UC1, cv::Scalar(77));
    EXPECT_EQ(worst(smooth(tiny), tiny), 0) << size;
  }
}

}  // namespace
}  // namespace vinebench::slam
