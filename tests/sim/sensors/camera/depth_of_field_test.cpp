// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/camera/depth_of_field.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "sim/render/image_encoding.h"

namespace vinebench::sim {
namespace {

constexpr double kFocal = 1000;                // px
constexpr DepthOfFieldConfig kLens{0.016, 1};  // m
constexpr float kFar = 2;                      // m; a radius of 0.5 * 16 * (1 - 1/2) = 4 px
const cv::Scalar kWhiteCode = cv::Scalar::all(255);

cv::Mat depths(float depth) {
  return {41, 41, CV_32FC1, cv::Scalar(static_cast<double>(depth))};
}

cv::Mat black() {
  return {41, 41, CV_8UC3, cv::Scalar::all(0)};
}

double light_at(const cv::Mat& codes, int x, int y) {
  return light_of_code(static_cast<double>(codes.at<cv::Vec3b>(y, x)[1]));
}

TEST(DepthOfFieldTest, TheDiscIsThatOfAThinLens) {
  // A lens of 5 mm that is focused at 1.25 m, 900 px long: 2.25 * |0.8 - 1 / z| px.
  const DepthOfFieldConfig lens{0.005, 1.25};
  EXPECT_NEAR(confusion_radius(lens, 900, 1.25), 0, 1e-12);
  EXPECT_NEAR(confusion_radius(lens, 900, 2.5), 0.9, 1e-12);
  EXPECT_NEAR(confusion_radius(lens, 900, 0.625), 1.8, 1e-12);
  EXPECT_NEAR(confusion_radius(lens, 900, 0), 1.8, 1e-12);  // infinitely far
  EXPECT_EQ(confusion_radius({0.05, 1}, 1000, 0), kWidestConfusion);
}

TEST(DepthOfFieldTest, APointBecomesAnEvenDiscThatKeepsItsLight) {
  cv::Mat image = black();
  image.at<cv::Vec3b>(20, 20) = {255, 255, 255};
  blur_by_depth(image, depths(kFar), kFocal, kLens);
  // 1 / (pi 4^2) = 0.0199 of the light, which is code 43: 255 * 0.0199^(1 / 2.2) = 43.0.
  EXPECT_EQ(image.at<cv::Vec3b>(20, 20)[1], 43);
  EXPECT_EQ(image.at<cv::Vec3b>(18, 22)[1], 43);  // 2.8 px off
  EXPECT_EQ(image.at<cv::Vec3b>(20, 25)[1], 0);   // 5 px off
  double sum = 0;
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) sum += light_at(image, x, y);
  }
  EXPECT_NEAR(sum, 1, 0.05);  // codes of 43 are rounded to 1 % of their light; the rim is of steps
}

TEST(DepthOfFieldTest, WhatIsInFocusStaysToTheByte) {
  cv::Mat image(41, 41, CV_8UC3);
  cv::randu(image, 0, 256);
  const cv::Mat before = image.clone();
  blur_by_depth(image, depths(1), kFocal, kLens);
  EXPECT_EQ(cv::norm(image, before, cv::NORM_INF), 0);
}

TEST(DepthOfFieldTest, AnEvenImageStaysAtAnyDepth) {
  cv::Mat image(41, 41, CV_8UC3, cv::Scalar(20, 120, 220));
  const cv::Mat before = image.clone();
  cv::Mat depth = depths(1);
  depth.colRange(0, 15).setTo(0);
  depth.colRange(15, 25).setTo(0.6);
  blur_by_depth(image, depth, kFocal, kLens);
  EXPECT_EQ(cv::norm(image, before, cv::NORM_INF), 0);
}

TEST(DepthOfFieldTest, WhatIsBehindDoesNotSpreadOverWhatIsInFocus) {
  cv::Mat image = black(), depth = depths(1);
  image.colRange(20, 41).setTo(kWhiteCode);
  depth.colRange(20, 41).setTo(kFar);
  blur_by_depth(image, depth, kFocal, kLens);
  for (int x = 0; x < 20; ++x) EXPECT_EQ(image.at<cv::Vec3b>(20, x)[1], 0) << x;
}

TEST(DepthOfFieldTest, WhatIsNearSpreadsOverWhatIsInFocusBehindIt) {
  cv::Mat image = black(), depth = depths(1);
  image.colRange(0, 20).setTo(kWhiteCode);
  depth.colRange(0, 20).setTo(2.0 / 3);  // a radius of 0.5 * 16 * (3 / 2 - 1) = 4 px
  blur_by_depth(image, depth, kFocal, kLens);
  EXPECT_GT(light_at(image, 21, 20), 0.02);
  EXPECT_EQ(image.at<cv::Vec3b>(20, 25)[1], 0);
}

}  // namespace
}  // namespace vinebench::sim
