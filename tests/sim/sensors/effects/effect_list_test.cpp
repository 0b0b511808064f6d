// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/effect_list.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "tests/support/effect_camera.h"

namespace vinebench::sim {
namespace {

class EffectListTest : public testing::Test {
 protected:
  EffectListTest() { config_.noise.enabled = false; }

  cv::Mat developed(double value) const {
    EffectChain effects = make_effects(config_, camera_.inputs());
    cv::Mat image = camera_.even_light(value);
    effects.develop(image, test::shot_at(0));
    return image;
  }
  cv::Mat red_of_wall(BayerPattern pattern) {
    config_.noise.enabled = true;
    config_.bayer = pattern;
    EffectChain effects = make_effects(config_, camera_.inputs());
    cv::Mat image(camera_.size(), CV_8UC3, cv::Scalar::all(100));
    effects.develop(image, test::shot_at(0));
    EXPECT_EQ(image.type(), CV_8UC3);
    return test::channel(image, 0);
  }
  static double deviation(const cv::Mat& image) {
    cv::Scalar mean, sigma;
    cv::meanStdDev(image, mean, sigma);
    return sigma[0];
  }

  test::EffectCamera camera_;
  EffectsConfig config_;
};

TEST_F(EffectListTest, OnlyTheNoiseIsOnByDefault) {
  // 255 * 0.25^(1 / 2.2) = 135.8
  const cv::Mat clean(camera_.size(), CV_8UC3, cv::Scalar::all(136));
  EXPECT_EQ(test::different_values(developed(0.25), clean), 0);
  config_ = {};
  EXPECT_GT(deviation(test::channel(developed(0.25), 0)), 1);
}

/// The lens darkens what a leaf on its glass shines with: where the polynomial reaches zero, a
/// leaf over the whole image stays dark. The other way round it would glow there.
TEST_F(EffectListTest, LightMeetsTheGlassBeforeTheLens) {
  config_.leaves.resize(1);
  config_.leaves[0].size = 10;
  config_.vignetting.polynomial = {-1, 0, 0};
  const cv::Mat image = developed(1);
  EXPECT_EQ(image.at<cv::Vec3b>(0, 0), cv::Vec3b::all(0));
  EXPECT_GT(image.at<cv::Vec3b>(44, 59)[1], 100);
}

/// Hot pixels shine where the lens lets no light through.
TEST_F(EffectListTest, ThePixelsComeBehindTheLens) {
  config_.vignetting.polynomial = {-10, 0, 0};  // black beyond a third of the way to the corners
  const cv::Rect corner(0, 0, 20, 20);
  EXPECT_EQ(cv::countNonZero(cv::Mat(developed(1), corner).clone().reshape(1)), 0);
  config_.fixed_pattern.hot_pixels = 0.1;
  // 400 pixels with a chance of 0.1 each; four deviations of sqrt(40) remain above ten.
  EXPECT_GT(cv::countNonZero(cv::Mat(developed(1), corner).clone().reshape(1)), 3 * 10);
}

/// Red is interpolated in three pixels of four, which averages its noise.
TEST_F(EffectListTest, TheNoiseIsOfTheMosaic) {
  const double plain = deviation(red_of_wall(BayerPattern::kNone));
  EXPECT_GT(plain, 1);
  EXPECT_LT(deviation(red_of_wall(BayerPattern::kRggb)), 0.9 * plain);
}

/// Red is doubled, then red and green change places: 136 is light of 0.251, its double 186.
TEST_F(EffectListTest, WhiteIsBalancedBeforeTheMatrix) {
  config_.white_balance.red = 2;
  config_.response.matrix = {0, 1, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_EQ(developed(0.25).at<cv::Vec3b>(44, 59), cv::Vec3b(136, 186, 136));
}

/// At a quality of 50 even grey keeps every second code, whatever curve comes before.
TEST_F(EffectListTest, CompressionIsLast) {
  config_.response.contrast = 0.7;
  const cv::Mat curved = developed(0.25);
  // x = 136 / 255: 255 * (x + 0.7 x (1 - x) (2 x - 1)) = 138.96
  EXPECT_EQ(curved.at<cv::Vec3b>(44, 59), cv::Vec3b::all(139));
  config_.jpeg.quality = 50;
  const int delivered = developed(0.25).at<cv::Vec3b>(44, 59)[1];
  EXPECT_TRUE(delivered == 138 || delivered == 140) << delivered;
}

TEST_F(EffectListTest, TheSunsGlareIsAmongThem) {
  const Pose ahead{};
  const DrawnView view{camera_.camera.model, ahead, 1};
  camera_.light.towards_sun = Eigen::Vector3f::UnitZ();  // the identity's optical axis
  EXPECT_TRUE(make_effects(config_, camera_.inputs()).wants_labels(view));
  camera_.light.glare = 0;
  EXPECT_FALSE(make_effects(config_, camera_.inputs()).wants_labels(view));
}

}  // namespace
}  // namespace vinebench::sim
