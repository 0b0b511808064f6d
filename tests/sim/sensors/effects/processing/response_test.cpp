// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/processing/response.h"

#include <gtest/gtest.h>

#include "tests/support/effect_camera.h"

namespace vinebench::sim {
namespace {

cv::Vec3b delivered(const ResponseConfig& config, double gamma, const cv::Vec3b& code) {
  cv::Mat codes(2, 3, CV_8UC3, cv::Scalar(code[0], code[1], code[2]));
  make_response(config, gamma)->apply(codes, {});
  return codes.at<cv::Vec3b>(1, 2);
}

TEST(ResponseTest, TheMatrixIsOnTheLinearSignal) {
  ResponseConfig config;
  config.matrix = {0.5, 0.5, 0, 0, 0, 1, 0, 1, 0};
  EXPECT_EQ(delivered(config, 1, {200, 100, 30}), cv::Vec3b(150, 30, 100));
  // Half of white: 255 * 0.5^(1 / 2.2) = 186.1.
  EXPECT_EQ(delivered(config, 2.2, {255, 0, 30}), cv::Vec3b(186, 30, 0));
}

TEST(ResponseTest, WithoutSaturationTheLuminanceIsLeft) {
  ResponseConfig config;
  config.saturation = 0;
  // 0.2126 * 200 + 0.7152 * 120 + 0.0722 * 40 = 131.2
  EXPECT_EQ(delivered(config, 1, {200, 120, 40}), cv::Vec3b::all(131));
  // Twice as far from there, clipped: 268.8, 108.8, -51.2.
  config.saturation = 2;
  EXPECT_EQ(delivered(config, 1, {200, 120, 40}), cv::Vec3b(255, 109, 0));
}

/// Also in the shadows, where codes of a large gamma lie close together in light.
TEST(ResponseTest, SaturationLeavesEveryGrey) {
  ResponseConfig config;
  config.saturation = 1.7;
  for (const double gamma : {1.0, 2.2, 4.0}) {
    for (int code = 0; code < 256; ++code) {
      const auto grey = cv::Vec3b::all(static_cast<std::uint8_t>(code));
      EXPECT_EQ(delivered(config, gamma, grey), grey) << gamma;
    }
  }
}

/// 3 x^2 - 2 x^3 of x = 64 / 255 is 0.1574, code 40.1; of the code as far from white the same from
/// there.
TEST(ResponseTest, ContrastIsAnSCurveOfTheCodes) {
  ResponseConfig config;
  config.contrast = 1;
  for (const double gamma : {1.0, 2.2}) {
    EXPECT_EQ(delivered(config, gamma, {0, 64, 191}), cv::Vec3b(0, 40, 215)) << gamma;
    EXPECT_EQ(delivered(config, gamma, {127, 128, 255}), cv::Vec3b(127, 128, 255)) << gamma;
  }
  // Half of the way from x: (64 + 40.1) / 2 = 52.1; the other way 64 + 11.9 = 75.9.
  config.contrast = 0.5;
  EXPECT_EQ(delivered(config, 2.2, cv::Vec3b::all(64)), cv::Vec3b::all(52));
  config.contrast = -0.5;
  EXPECT_EQ(delivered(config, 2.2, cv::Vec3b::all(64)), cv::Vec3b::all(76));
}

TEST(ResponseTest, TheCurveClimbsAtEitherEndOfItsRange) {
  for (const double contrast : {-1.0, 1.0}) {
    const ResponseConfig config{.contrast = contrast};
    for (int i = 0; i < 100; ++i) EXPECT_LT(config.curve(0.01 * i), config.curve(0.01 * (i + 1)));
  }
}

TEST(ResponseTest, TheDefaultsNeedNoEffect) {
  EXPECT_EQ(make_response({}, 2.2), nullptr);
  EXPECT_NE(make_response({.contrast = 0.1}, 2.2), nullptr);
  EXPECT_NE(make_response({.saturation = 1.1}, 2.2), nullptr);
  EXPECT_NE(make_response({.matrix = {1, 0, 0, 0, 1, 0, 0, 0.1, 1}}, 2.2), nullptr);
}

}  // namespace
}  // namespace vinebench::sim
