// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/image_encoding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

namespace vinebench::sim {
namespace {

TEST(ImageEncodingTest, CodesArePowersOfLight) {
  EXPECT_EQ(light_of_code(0), 0);
  EXPECT_EQ(light_of_code(255), 1);
  EXPECT_NEAR(light_of_code(127.5), std::exp2(-2.2), 1e-12);  // half the code
  EXPECT_NEAR(code_of_light(std::exp2(-2.2)), 127.5, 1e-10);
  EXPECT_NEAR(light_of_code(51, 1), 0.2, 1e-12);  // a gamma of 1 is linear
  EXPECT_NEAR(code_of_light(0.25, 2), 127.5, 1e-10);
}

TEST(ImageEncodingTest, LightBeyondItsRangeSaturates) {
  EXPECT_EQ(code_of_light(-0.1), 0);
  EXPECT_EQ(code_of_light(1.1), 255);
  const cv::Mat light = (cv::Mat_<cv::Vec3f>(1, 2) << cv::Vec3f(-1, 0, 1e-9f),
                         cv::Vec3f(1, 2, std::numeric_limits<float>::infinity()));
  const cv::Mat codes = to_codes(light);
  ASSERT_EQ(codes.type(), CV_8UC3);
  EXPECT_EQ(codes.at<cv::Vec3b>(0), cv::Vec3b(0, 0, 0));
  EXPECT_EQ(codes.at<cv::Vec3b>(1), cv::Vec3b(255, 255, 255));
}

/// Each channel has codes of its own: channels and columns are not mixed up.
cv::Mat all_codes() {
  cv::Mat codes(2, 128, CV_8UC3);
  for (int i = 0; i < 256; ++i) {
    codes.at<cv::Vec3b>(i / 128, i % 128) =
        cv::Vec3b(static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(255 - i),
                  static_cast<std::uint8_t>(i ^ 85));
  }
  return codes;
}

TEST(ImageEncodingTest, ThereAndBackGivesTheSameCodes) {
  const cv::Mat codes = all_codes();
  const cv::Mat light = to_light(codes);
  ASSERT_EQ(light.type(), CV_32FC3);
  EXPECT_NEAR(light.at<cv::Vec3f>(0, 51)[0], std::pow(0.2, 2.2), 1e-7);
  EXPECT_NEAR(light.at<cv::Vec3f>(0, 0)[1], 1, 1e-7);
  EXPECT_EQ(cv::norm(to_codes(light), codes, cv::NORM_INF), 0);
}

TEST(ImageEncodingTest, LightIsRoundedToTheNearestCode) {
  cv::Mat light(1, 200000, CV_32FC3);
  for (int i = 0; i < light.cols; ++i) {
    const double root = 0.01 + 0.99 * i / (light.cols - 1);
    light.at<cv::Vec3f>(i) = cv::Vec3f::all(static_cast<float>(root * root));
  }
  const cv::Mat codes = to_codes(light);
  double worst = 0;
  for (int i = 0; i < light.cols; ++i) {
    const double exact = code_of_light(light.at<cv::Vec3f>(i)[0]);
    worst = std::max(worst, std::abs(codes.at<cv::Vec3b>(i)[0] - exact));
  }
  // The table knows a root to 1 / 16384. A code is 255 root^(1 / 1.1), of which that is 0.014 in
  // white and 0.0215 where the root is 0.01.
  EXPECT_LT(worst, 0.522);
}

TEST(ImageEncodingTest, SharesOfLightAddUp) {
  const cv::Mat a = all_codes();
  cv::Mat b;
  cv::subtract(cv::Scalar::all(255), a, b);
  cv::Mat sum;
  add_light(a, 0.25f, sum);
  add_light(b, 0.75f, sum);
  const cv::Mat expected = 0.25 * to_light(a) + 0.75 * to_light(b);
  EXPECT_LT(cv::norm(sum, expected, cv::NORM_INF), 1e-6);
}

}  // namespace
}  // namespace vinebench::sim
