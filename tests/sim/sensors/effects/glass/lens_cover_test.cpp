// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/glass/lens_cover.h"

#include <gtest/gtest.h>

#include "tests/support/effect_camera.h"

namespace vinebench::sim {
namespace {

TEST(LensCoverTest, MixesItsOwnLightWithTheImages) {
  cv::Mat light(1, 3, CV_32FC3, cv::Scalar(0.9, 0.6, 0.3));
  LensCover cover;
  cover.opacity = (cv::Mat_<float>(1, 3) << 0, 0.5f, 1);
  cover.glow = {1, 0.5f, 0};
  cover.apply(light);
  // Lit by the mean of all channels, 0.6: opaque it is (0.6, 0.3, 0).
  EXPECT_EQ(light.at<cv::Vec3f>(0), cv::Vec3f(0.9f, 0.6f, 0.3f));
  EXPECT_LT(cv::norm(light.at<cv::Vec3f>(1) - cv::Vec3f(0.75f, 0.45f, 0.15f)), 1e-6);
  EXPECT_LT(cv::norm(light.at<cv::Vec3f>(2) - cv::Vec3f(0.6f, 0.3f, 0)), 1e-6);
}

TEST(LensCoverTest, AShapeIsFilledInside) {
  cv::Mat map = cv::Mat::zeros(40, 50, CV_32FC1);
  fill_shape(map, {{10, 5}, {30, 5}, {30, 25}, {10, 25}}, 0.7);
  for (int y = 0; y < map.rows; ++y) {
    for (int x = 0; x < map.cols; ++x) {
      const bool inside = x >= 10 && x <= 30 && y >= 5 && y <= 25;
      EXPECT_EQ(map.at<float>(y, x), inside ? 0.7f : 0.0f) << x << " " << y;
    }
  }
}

TEST(LensCoverTest, DefocusSpreadsAnEdgeByItsDeviation) {
  cv::Mat map = cv::Mat::zeros(40, 60, CV_32FC1);
  map.colRange(30, 60) = 1;
  const cv::Mat sharp = map.clone();
  defocus(map, 0);
  EXPECT_EQ(test::different_values(map, sharp), 0);
  defocus(map, 3);
  // The edge lies at 29.5; 4.5 px are 1.5 deviations: the normal distribution's 6.7 % and 93.3 %.
  // A kernel of whole pixels agrees with it to about 1 %.
  EXPECT_NEAR(map.at<float>(20, 25), 0.067, 0.01);
  EXPECT_NEAR(map.at<float>(20, 34), 0.933, 0.01);
  EXPECT_NEAR(map.at<float>(20, 29) + map.at<float>(20, 30), 1, 1e-5);
}

TEST(LensCoverTest, EachIsOnTheGlassInItsTime) {
  EXPECT_EQ(make_cover_effect({}), nullptr);
  const test::EffectCamera camera;
  const cv::Mat half(camera.size(), CV_32FC1, cv::Scalar(0.5));
  LensCover early{{{}, 1, 3.0}, half, {}}, late{{{}, 2, std::nullopt}, half, {}};
  const auto effect = make_cover_effect({early, late});
  // Each black cover leaves half of the light.
  const std::vector<std::pair<double, float>> expected{{0.5, 1}, {1, 0.5f}, {2, 0.25f}, {3, 0.5f}};
  for (const auto& [seconds, left] : expected) {
    EXPECT_EQ(effect->is_active(from_seconds(seconds)), seconds >= 1);
    const cv::Mat light = test::applied(*effect, camera, 1, test::shot_at(seconds));
    EXPECT_EQ(light.at<cv::Vec3f>(50, 60), cv::Vec3f::all(left)) << seconds;
  }
}

}  // namespace
}  // namespace vinebench::sim
