// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/glass/lens_dirt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "tests/support/effect_camera.h"

namespace vinebench::sim {
namespace {

class LensDirtTest : public testing::Test {
 protected:
  LensDirtTest() {
    config_.glow = 0;
    config_.blur_px = 0;
  }
  /// What is left of even light of 1.
  cv::Mat behind(int index = 0, std::uint64_t seed = 1) const {
    return test::channel(
        test::applied(*make_lens_dirt({config_}, camera_.inputs(index, seed)), camera_, 1), 0);
  }
  test::EffectCamera camera_;
  LensDirtConfig config_;
};

TEST_F(LensDirtTest, IsOnTheCamerasOfItsScopeAlone) {
  config_.scope.cameras = {"right"};
  EXPECT_EQ(make_lens_dirt({config_}, camera_.inputs()), nullptr);
  config_.scope.cameras = {"right", "left"};
  EXPECT_NE(make_lens_dirt({config_}, camera_.inputs()), nullptr);
  EXPECT_EQ(make_lens_dirt({}, camera_.inputs()), nullptr);
}

TEST_F(LensDirtTest, NoSpeckTakesMoreThanItsOpacity) {
  config_.opacity = 0.8;
  config_.count = 200;
  config_.radius_px = {3, 8};
  double least = 0, most = 0;
  cv::minMaxLoc(behind(), &least, &most);
  EXPECT_GE(least, 0.2 - 1e-6);
  // Shares of 0.35 to 1: of 200 specks, many of them seen whole, one takes more than 0.9 of it.
  EXPECT_LT(least, 1 - 0.9 * 0.8);
  EXPECT_EQ(most, 1);  // and some glass is clean
}

/// The area of r(a) = R (1 + d cos 2a + d cos 3a) is pi R^2 (1 + d^2); d is 0.05 to 0.25. Pixels
/// on the outline, about 2 pi R of them, count in with half of theirs: 1 / R more.
TEST_F(LensDirtTest, ASpeckHasItsRadius) {
  constexpr double kRadius = 15;
  config_.count = 1;
  config_.radius_px = {kRadius, kRadius};
  double largest = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    largest = std::max(largest, double(cv::countNonZero(behind(0, seed) < 1)));
  }
  // The largest of twenty is one that the image's border does not cut.
  const double disc = std::numbers::pi * kRadius * kRadius;
  EXPECT_GT(largest, 0.98 * disc);
  EXPECT_LT(largest, (1 + 0.25 * 0.25 + 1.2 / kRadius) * disc);
}

TEST_F(LensDirtTest, SeedCameraAndPatternEachChangeIt) {
  const cv::Mat first = behind();
  EXPECT_EQ(test::different_values(behind(), first), 0);
  EXPECT_GT(test::different_values(behind(1), first), 1000);
  EXPECT_GT(test::different_values(behind(0, 2), first), 1000);
  config_.pattern = 1;
  EXPECT_GT(test::different_values(behind(), first), 1000);
}

TEST_F(LensDirtTest, ScattersAYellowishShareOfTheLight) {
  config_.count = 2000;  // no clean glass
  config_.opacity = 1;
  const auto darkest = [&] {
    double least = 0;
    cv::minMaxLoc(behind(), &least);
    return least;
  };
  EXPECT_LT(darkest(), 0.05);
  config_.glow = 0.35;
  EXPECT_NEAR(darkest(), 0.35 * 1.1, 0.05);  // dust: 1.1 of red, 0.85 of blue
}

}  // namespace
}  // namespace vinebench::sim
