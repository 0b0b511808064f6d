// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/fixed_pattern.h"

#include <gtest/gtest.h>

#include "tests/support/effect_camera.h"

namespace vinebench::sim {
namespace {

constexpr double kWhite = 5000;  // electrons

class FixedPatternTest : public testing::Test {
 protected:
  cv::Mat on(double value, double exposure_time = 0.002, int camera = 0) const {
    cv::Mat light = camera_.even_light(value);
    FixedPattern(config_, camera_.size(), 1, camera).apply(light, exposure_time, kWhite);
    return light;
  }
  static std::pair<double, double> moments(const cv::Mat& light) {
    cv::Scalar mean, sigma;
    cv::meanStdDev(light, mean, sigma);
    return {mean[0], sigma[0]};
  }
  test::EffectCamera camera_;
  FixedPatternConfig config_;
};

// 10800 draws: their deviation is known to 1 / sqrt(2 * 10800) = 0.7 %, their mean to 1 % of it.
TEST_F(FixedPatternTest, ResponseScalesTheLight) {
  config_.response = 0.05;
  const auto [mean, sigma] = moments(on(0.4));
  EXPECT_NEAR(mean, 0.4, 0.4 * 0.05 * 0.04);
  EXPECT_NEAR(sigma, 0.4 * 0.05, 0.03 * 0.4 * 0.05);
  EXPECT_EQ(cv::countNonZero(on(0).reshape(1)), 0);
}

TEST_F(FixedPatternTest, OffsetIsAddedWhateverTheLight) {
  config_.offset = 100;
  const auto [dark_mean, dark_sigma] = moments(on(0));
  EXPECT_NEAR(dark_mean, 0, 0.04 * 100 / kWhite);
  EXPECT_NEAR(dark_sigma, 100 / kWhite, 0.03 * 100 / kWhite);
  EXPECT_NEAR(moments(on(0.5)).first, 0.5 + dark_mean, 1e-6);
}

TEST_F(FixedPatternTest, HotPixelsLeakInProportionToTheTime) {
  config_.hot_pixels = 0.01;
  config_.hot_pixel_current = 1e6;
  const cv::Mat leaks = test::channel(on(0, 0.001), 0);
  // 108 draws; two may fall on one pixel, about 108^2 / 2 / 10800 = 0.5 times.
  EXPECT_LE(cv::countNonZero(leaks), 108);
  EXPECT_GE(cv::countNonZero(leaks), 100);
  // Leaks scatter by their mean, 1e6 * 1 ms of 5000: the sum of 108 by a tenth.
  EXPECT_NEAR(cv::sum(leaks)[0], 108 * 0.2, 0.4 * 108 * 0.2);
  const cv::Mat longer = test::channel(on(0, 0.004), 0);
  EXPECT_LT(cv::norm(longer, 4 * leaks, cv::NORM_INF), 1e-5);
}

TEST_F(FixedPatternTest, EachCameraHasItsOwnAndKeepsIt) {
  config_.response = 0.05;
  config_.offset = 10;
  config_.hot_pixels = 0.01;
  const cv::Mat first = on(0.5);
  EXPECT_EQ(test::different_values(first, on(0.5)), 0);
  EXPECT_GT(test::different_values(first, on(0.5, 0.002, 1)), 30000);
}

TEST_F(FixedPatternTest, GainMakesWhiteOfFewerElectrons) {
  EXPECT_EQ(make_fixed_pattern(config_, kWhite, camera_.inputs()), nullptr);
  config_.offset = 20;
  const auto effect = make_fixed_pattern(config_, kWhite, camera_.inputs());
  const cv::Mat plain = test::applied(*effect, camera_, 0, test::shot_at(0, 0.002, 0));
  const cv::Mat raised = test::applied(*effect, camera_, 0, test::shot_at(0, 0.002, 20));
  // 20 dB are ten times the signal; offsets of 0.004 of white.
  EXPECT_LT(cv::norm(raised, 10 * plain, cv::NORM_INF), 1e-6);
  EXPECT_NEAR(moments(plain).second, 20 / kWhite, 0.03 * 20 / kWhite);
}

}  // namespace
}  // namespace vinebench::sim
