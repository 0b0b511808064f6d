// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/stereo/eye_balance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "tests/support/synthetic_plane.h"

namespace vinebench::slam {
namespace {

using test::SyntheticPlane;

constexpr double kEyesBaseline = 0.12;  // m
constexpr double kEyesFocal = 263.0;    // px
constexpr double kEyesNoise = 1.5;      // grey levels

/// A wall 2 m away: 263 px * 0.12 m / 2 m = 15.8 px.
const SyntheticPlane kWall{15.8, 0.02, 0.01, 640, 400, 3};

cv::Mat scaled(const cv::Mat& image, double gain) {
  cv::Mat result;
  image.convertTo(result, CV_8UC1, gain);
  return result;
}

class EyeBalanceTest : public testing::Test {
 protected:
  std::vector<StereoMatch> match(const Extraction& left, const cv::Mat& right, double gain) const {
    const PinholeCamera lens{
        left.pyramid[0].cols, left.pyramid[0].rows, kEyesFocal, kEyesFocal, 320, 200, {}};
    return match_stereo(left, {{}, pyramid(right, gain)}, lens, kEyesBaseline, extractor_, {});
  }
  std::vector<cv::Mat> pyramid(const cv::Mat& right, double gain) const {
    return extractor_.pyramid(EyeBalance::balanced(right, gain));
  }
  static std::ptrdiff_t found(const std::vector<StereoMatch>& matches) {
    return std::ranges::count_if(matches, [](const StereoMatch& m) { return m.x_right >= 0; });
  }

  /// One frame, as FrontEnd does it. Returns how many features were found.
  std::ptrdiff_t see(const cv::Mat& left_image, const cv::Mat& right) {
    const Extraction left = extractor_.extract(left_image);
    double gain = balance_.gain();
    auto matches = match(left, right, gain);
    if (const auto suspected = balance_.suspect(left_image, right, matches)) {
      suspicions_.push_back(*suspected);
      auto tried = match(left, right, *suspected);
      if (balance_.believe(*suspected, matches, tried)) {
        matches = std::move(tried);
        gain = *suspected;
      }
    }
    balance_.measure(left, pyramid(right, gain), matches, extractor_);
    return found(matches);
  }

  OrbExtractor extractor_{OrbConfig{}};
  EyeBalance balance_;
  std::vector<double> suspicions_;
};

TEST_F(EyeBalanceTest, EyesThatAgreeAreLeftAlone) {
  const cv::Mat right = kWall.right(kEyesNoise);
  EXPECT_GT(see(kWall.left(kEyesNoise), right), 500);
  EXPECT_EQ(balance_.gain(), 1);
  EXPECT_TRUE(suspicions_.empty());
  EXPECT_EQ(EyeBalance::balanced(right, balance_.gain()).data, right.data);
}

TEST_F(EyeBalanceTest, ScalesAndSaturates) {
  const cv::Mat right = (cv::Mat_<std::uint8_t>(1, 4) << 0, 101, 170, 200);
  const cv::Mat balanced = EyeBalance::balanced(right, 1.5);
  // 1.5 * 101 = 151.5, rounded away from zero; 1.5 * 200 = 300 is more than a byte holds.
  EXPECT_EQ(cv::countNonZero(balanced != (cv::Mat_<std::uint8_t>(1, 4) << 0, 152, 255, 255)), 0);
}

class EyeBalanceGainTest : public EyeBalanceTest, public testing::WithParamInterface<double> {};

TEST_P(EyeBalanceGainTest, IsFoundInTheFirstFrame) {
  const double truth = GetParam();  // left over right
  const cv::Mat left = truth < 1 ? scaled(kWall.left(kEyesNoise), truth) : kWall.left(kEyesNoise);
  const cv::Mat right =
      truth < 1 ? kWall.right(kEyesNoise) : scaled(kWall.right(kEyesNoise), 1 / truth);
  EXPECT_GT(see(left, right), 500);
  // Grey levels are rounded: half a level of 50, a dim wall's, is one percent.
  EXPECT_NEAR(balance_.gain(), truth, 0.01 * truth);
  const auto once = suspicions_.size();
  EXPECT_GT(see(left, right), 500);
  EXPECT_EQ(suspicions_.size(), once) << "what was measured holds for the next frame";
  EXPECT_NEAR(balance_.gain(), truth, 0.01 * truth);
}

INSTANTIATE_TEST_SUITE_P(Gains, EyeBalanceGainTest,
                         testing::Values(0.4, 0.62, 0.9, 1.12, 1.6, 2.5));

TEST_F(EyeBalanceTest, SaturationDoesNotBiasIt) {
  // Nine tenths of the levels of a wall of 0 to 255 lie below 1.4 * 182 = 255: the rest saturates
  // in the left eye, and where it does 255 / 182 and less would be measured.
  const cv::Mat left = scaled(kWall.left(kEyesNoise), 1.4);
  ASSERT_GT(cv::countNonZero(left == 255), static_cast<int>(left.total()) / 20);
  EXPECT_GT(see(left, kWall.right(kEyesNoise)), 400);
  EXPECT_NEAR(balance_.gain(), 1.4, 0.02 * 1.4);
}

TEST_F(EyeBalanceTest, ABoardBeforeOneEyeIsNoGain) {
  // The board hides nine tenths of the right image, and is darker than the wall: the two images'
  // grey levels differ, and what little both see does not.
  const cv::Mat left = kWall.left(kEyesNoise);
  cv::Mat right = kWall.right(kEyesNoise).clone();
  right.colRange(64, right.cols) = cv::Scalar(60);
  see(left, right);
  ASSERT_FALSE(suspicions_.empty());
  EXPECT_GT(suspicions_.front(), 1.5);
  EXPECT_EQ(balance_.gain(), 1);
}

TEST_F(EyeBalanceTest, FollowsAnExposureThatChanges) {
  double gain = 1;
  for (int frame = 0; frame < 8; ++frame, gain *= 1.12) {
    EXPECT_GT(see(kWall.left(kEyesNoise), scaled(kWall.right(kEyesNoise), 1 / gain)), 500);
    EXPECT_NEAR(balance_.gain(), gain, 0.01 * gain) << frame;
  }
}

}  // namespace
}  // namespace vinebench::slam
