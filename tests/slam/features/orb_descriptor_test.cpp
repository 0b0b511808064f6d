// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/features/orb_descriptor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "core/util/random.h"

namespace vinebench::slam {
namespace {

constexpr int kSide = 101;  // px
constexpr int kMiddle = 50;

cv::Mat black() {
  return {kSide, kSide, CV_8UC1, cv::Scalar(0)};
}

/// Independent grey levels of 0 to 199.
cv::Mat noise(std::uint64_t seed) {
  const RandomStream random(seed, "grey");
  cv::Mat image = black();
  for (int i = 0; i < kSide * kSide; ++i) {
    image.at<std::uint8_t>(i / kSide, i % kSide) =
        static_cast<std::uint8_t>(random.uniform(static_cast<std::uint64_t>(i), 0, 200));
  }
  return image;
}

Descriptor describe(const cv::Mat& image, float angle = 0) {
  return rotated_brief(image, kMiddle, kMiddle, angle);
}

TEST(CentroidAngleTest, PointsUpTheSlopeOfAGreyRamp) {
  for (double angle = -3; angle < 3.1; angle += 0.5) {
    cv::Mat image = black();
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const double along = (x - kMiddle) * std::cos(angle) + (y - kMiddle) * std::sin(angle);
        image.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(120 + 3 * along);
      }
    }
    // Grey levels are rounded, by 0.3 of 45 over the disc, and some 700 of them average.
    EXPECT_NEAR(centroid_angle(image, kMiddle, kMiddle), angle, 0.003);
  }
}

/// A disc of 31 px: x^2 + y^2 below 15.5^2 = 240.25.
TEST(CentroidAngleTest, OnlyTheDiscCounts) {
  const auto angle_with = [](int dx, int dy) {
    cv::Mat image = black();
    image.at<std::uint8_t>(kMiddle + dy, kMiddle + dx) = 255;
    return centroid_angle(image, kMiddle, kMiddle);
  };
  EXPECT_NEAR(angle_with(0, -15), -std::numbers::pi / 2, 1e-6);
  EXPECT_EQ(angle_with(0, -16), 0);
  EXPECT_NEAR(angle_with(-15, 0), std::numbers::pi, 1e-6);
  EXPECT_EQ(angle_with(-16, 0), 0);
  EXPECT_NEAR(angle_with(10, 11), std::atan2(11, 10), 1e-6);  // 221
  EXPECT_EQ(angle_with(11, 11), 0);                           // 242
}

TEST(RotatedBriefTest, TurnsWithTheImage) {
  const cv::Mat upright = noise(1);
  cv::Mat turned;
  // Clockwise as seen, which is from x towards y.
  cv::rotate(upright, turned, cv::ROTATE_90_CLOCKWISE);
  for (const float angle : {0.0f, 0.4f, -1.3f}) {
    const auto quarter = static_cast<float>(std::numbers::pi / 2);
    const Descriptor a = describe(upright, angle), b = describe(turned, angle + quarter);
    // But for places half a pixel between two, which may be rounded either way.
    EXPECT_LE(hamming_distance(a, b), 4) << angle;
    EXPECT_GT(hamming_distance(a, describe(turned, angle)), 64) << angle;
  }
}

TEST(RotatedBriefTest, AnglesAreRoundedToA128thOfATurn) {
  const cv::Mat image = noise(2);
  const auto step = static_cast<float>(2 * std::numbers::pi / 128);
  const Descriptor at_zero = describe(image);
  EXPECT_EQ(describe(image, 0.45f * step), at_zero);
  EXPECT_EQ(describe(image, -0.45f * step), at_zero);
  EXPECT_EQ(describe(image, 128 * step), at_zero);
  EXPECT_NE(describe(image, 0.55f * step), at_zero);
}

TEST(RotatedBriefTest, ComparesOnlyWithinItsReach) {
  const cv::Mat image = noise(3);
  cv::Mat changed = noise(4);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      if (std::hypot(x - kMiddle, y - kMiddle) > kOrbReach) continue;
      changed.at<std::uint8_t>(y, x) = image.at<std::uint8_t>(y, x);
    }
  }
  for (const float angle : {0.0f, 0.7f, 2.0f}) {
    EXPECT_EQ(describe(changed, angle), describe(image, angle));
  }
}

TEST(RotatedBriefTest, IsAboutOrderNotBrightness) {
  const cv::Mat image = noise(5);
  EXPECT_EQ(describe(cv::Mat(image + cv::Scalar(50))), describe(image));
  // Of independent levels of 200, one comparison in 200 is of equal ones, which is no "less" either
  // way: of 256 some 1.3.
  EXPECT_GE(hamming_distance(describe(cv::Mat(200 - image)), describe(image)), 256 - 8);
}

TEST(RotatedBriefTest, UnlikeImagesDifferInHalfOfTheirBits) {
  // 128 with a deviation of 8; the comparisons share some pixels.
  EXPECT_NEAR(hamming_distance(describe(noise(6)), describe(noise(7))), 128, 40);
}

}  // namespace
}  // namespace vinebench::slam
