// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/vignette.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/effect_camera.h"

namespace vinebench::sim {
namespace {

class VignetteTest : public testing::Test {
 protected:
  float share(int x, int y) const {
    return vignette(config_, camera_.camera.model).at<float>(y, x);
  }
  test::EffectCamera camera_;
  VignettingConfig config_;
};

TEST_F(VignetteTest, FollowsCosToTheFourth) {
  camera_.camera.model.cx = 60;
  camera_.camera.model.cy = 40;
  config_.natural = 1;
  EXPECT_NEAR(share(60, 40), 1, 1e-6);
  // (30, 80) is 50 px away: tan = 0.5, cos^2 = 1 / 1.25.
  EXPECT_NEAR(share(30, 80), 1 / (1.25 * 1.25), 1e-6);
  config_.natural = 0.5;
  EXPECT_NEAR(share(30, 80), 0.5 + 0.5 / (1.25 * 1.25), 1e-6);
}

TEST_F(VignetteTest, PolynomialReachesItsSumInTheFarthestCorner) {
  config_.polynomial = {-0.3, 0.1, -0.2};
  EXPECT_NEAR(share(0, 0), 0.6, 1e-6);
  EXPECT_NEAR(share(119, 89), 0.6, 1e-6);
  camera_.camera.model.cx = 29;  // now the right corners are 90 px off, the left ones 29
  EXPECT_NEAR(share(119, 0), 0.6, 1e-6);
  EXPECT_GT(share(0, 0), 0.9);
}

TEST_F(VignetteTest, BothLawsMultiply) {
  config_.natural = 1;
  const float natural = share(10, 20);
  config_.natural = 0;
  config_.polynomial = {-0.5, 0, 0};
  const float polynomial = share(10, 20);
  config_.natural = 1;
  EXPECT_NEAR(share(10, 20), natural * polynomial, 1e-6);
}

TEST_F(VignetteTest, NoPixelGetsLessThanNothing) {
  config_.polynomial = {-10, 0, 0};
  double least = 1;
  cv::minMaxLoc(vignette(config_, camera_.camera.model), &least);
  EXPECT_EQ(least, 0);
}

TEST_F(VignetteTest, TheEffectScalesEveryChannel) {
  EXPECT_EQ(make_vignetting(config_, camera_.inputs()), nullptr);
  config_.polynomial = {-0.4, 0, 0};
  const cv::Mat light = test::applied(*make_vignetting(config_, camera_.inputs()), camera_, 0.5);
  EXPECT_LT(cv::norm(light.at<cv::Vec3f>(0, 0) - cv::Vec3f::all(0.3f)), 1e-6);
}

}  // namespace
}  // namespace vinebench::sim
