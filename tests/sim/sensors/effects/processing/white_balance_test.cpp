// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/processing/white_balance.h"

#include <gtest/gtest.h>

#include "tests/support/effect_camera.h"

namespace vinebench::sim {
namespace {

cv::Vec3b balanced(const WhiteBalanceConfig& config, double gamma, const cv::Vec3b& code) {
  cv::Mat codes(2, 3, CV_8UC3, cv::Scalar(code[0], code[1], code[2]));
  make_white_balance(config, gamma)->apply(codes, {});
  return codes.at<cv::Vec3b>(1, 2);
}

/// Red against green 1.5, blue 0.75: amplified by 1.5 / 0.75 = 2, 1 / 0.75 = 1.333 and 1.
TEST(WhiteBalanceTest, ItAmplifiesTheLinearSignal) {
  const WhiteBalanceConfig config{1.5, 0.75};
  EXPECT_EQ(balanced(config, 1, {100, 100, 100}), cv::Vec3b(200, 133, 100));
  // A factor k of the signal is k^(1 / 2.2) of the code: 1.3703, 1.1397, 1.
  EXPECT_EQ(balanced(config, 2.2, {100, 100, 100}), cv::Vec3b(137, 114, 100));
}

TEST(WhiteBalanceTest, WhatSaturatesStaysWhite) {
  for (const WhiteBalanceConfig& config :
       {WhiteBalanceConfig{0.5, 0.8}, WhiteBalanceConfig{2, 0.5}, WhiteBalanceConfig{1, 3}}) {
    EXPECT_EQ(balanced(config, 2.2, cv::Vec3b::all(255)), cv::Vec3b::all(255));
    EXPECT_EQ(balanced(config, 2.2, cv::Vec3b::all(0)), cv::Vec3b::all(0));
  }
}

TEST(WhiteBalanceTest, GreysOfANeutralSettingNeedNoEffect) {
  EXPECT_EQ(make_white_balance({}, 2.2), nullptr);
  EXPECT_NE(make_white_balance({1, 1.01}, 2.2), nullptr);
}

}  // namespace
}  // namespace vinebench::sim
