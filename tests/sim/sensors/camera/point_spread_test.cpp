// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/camera/point_spread.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace vinebench::sim {
namespace {

cv::Mat point(int type, const cv::Scalar& value) {
  cv::Mat image(7, 9, type, cv::Scalar::all(0));
  image(cv::Rect(4, 3, 1, 1)).setTo(value);
  return image;
}

TEST(PointSpreadTest, APointOfLightHasItsVarianceAndKeepsItsLight) {
  cv::Mat image = point(CV_32FC3, cv::Scalar(1, 0.5, 0.25));
  spread_points(image, 0.6);
  double sum = 0, squares = 0;
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const auto light = static_cast<double>(image.at<cv::Vec3f>(y, x)[0]);
      sum += light;
      squares += light * (x - 4) * (x - 4);
      EXPECT_FLOAT_EQ(image.at<cv::Vec3f>(y, x)[1], 0.5f * image.at<cv::Vec3f>(y, x)[0]);
    }
  }
  EXPECT_NEAR(sum, 1, 1e-6);
  EXPECT_NEAR(squares, 0.36, 1e-6);  // sigma^2 along each axis
}

TEST(PointSpreadTest, CodesAreSpreadAsTheirSquares) {
  cv::Mat image(4, 8, CV_8UC3, cv::Scalar::all(0));
  image.colRange(4, 8).setTo(cv::Scalar::all(255));
  spread_points(image, 0.5);
  // An eighth of the light (half of 0.25 px^2) crosses the edge: 255 sqrt(1/8) = 90.2 and
  // 255 sqrt(7/8) = 238.5; with the encoding's 2.2 in place of 2 these are 99.1 and 240.0.
  const int expected[] = {0, 0, 0, 90, 239, 255, 255, 255};
  for (int x = 0; x < 8; ++x) EXPECT_EQ(image.at<cv::Vec3b>(2, x)[1], expected[x]) << x;
}

TEST(PointSpreadTest, AnEvenImageStaysToTheRim) {
  for (int code = 0; code < 256; ++code) {
    cv::Mat image(3, 4, CV_8UC3, cv::Scalar(code, 255 - code, 7));
    const cv::Mat before = image.clone();
    spread_points(image, kWidestPointSpread);
    EXPECT_EQ(cv::norm(image, before, cv::NORM_INF), 0) << code;
  }
}

TEST(PointSpreadTest, OfNoWidthChangesNothing) {
  cv::Mat image = point(CV_8UC3, cv::Scalar(200, 100, 50));
  const cv::Mat before = image.clone();
  spread_points(image, 0);
  EXPECT_EQ(cv::norm(image, before, cv::NORM_INF), 0);
}

TEST(PointSpreadTest, ASinglePixelIsItsOwnNeighbour) {
  cv::Mat image(1, 1, CV_8UC3, cv::Scalar(10, 20, 30));
  spread_points(image, 0.5);
  EXPECT_EQ(image.at<cv::Vec3b>(0, 0), cv::Vec3b(10, 20, 30));
}

}  // namespace
}  // namespace vinebench::sim
