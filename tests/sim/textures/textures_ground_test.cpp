// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "sim/textures/textures.h"
#include "tests/support/same_texture.h"

namespace vinebench::sim {
namespace {

using test::same_texels;

TEST(GroundTexturesTest, ASeedIsOneImageThatRepeats) {
  using Make = Texture (*)(std::uint64_t);
  const Make grass = [](std::uint64_t seed) { return grass_texture(seed, 0.3); };
  const Make woods = [](std::uint64_t seed) { return woods_texture(seed, 0.3); };
  for (const Make make : {grass, woods, Make(stone_texture)}) {
    const Texture first = make(1);
    EXPECT_TRUE(first.repeat) << first.name;
    EXPECT_TRUE(same_texels(first, make(1))) << first.name;
    EXPECT_FALSE(same_texels(first, make(2))) << first.name;
  }
}

// Blades stand on the lowest row, apart from each other, and few reach the top.
TEST(GroundTexturesTest, StandingGrassThinsOutUpwards) {
  const Texture sward = sward_texture(1);
  EXPECT_TRUE(same_texels(sward, sward_texture(1)));
  cv::Mat alpha;
  cv::extractChannel(sward.rgba, alpha, 3);
  const auto covered = [&](int row) { return cv::mean(alpha.row(row))[0] / 255; };
  EXPECT_GT(covered(alpha.rows - 1), 0.4);
  EXPECT_LT(covered(alpha.rows - 1), 0.95);
  EXPECT_LT(covered(alpha.rows / 2), 0.6 * covered(alpha.rows - 1));
  EXPECT_LT(covered(0), 0.02);
}

// The tracks and the bare strips are soil, between them stands grass: greener than red.
TEST(GroundTexturesTest, AnAisleIsBareUnderTheVinesAndGreenInItsMiddle) {
  const Texture aisle = aisle_texture(1, {});
  const auto greenness = [&](double from, double to) {
    const int columns = aisle.rgba.cols;
    const cv::Scalar mean = cv::mean(
        aisle.rgba.colRange(static_cast<int>(from * columns), static_cast<int>(to * columns)));
    return mean[1] - mean[0];
  };
  EXPECT_GT(greenness(0.48, 0.52), 0);
  EXPECT_GT(greenness(0.48, 0.52), greenness(0, 0.05) + 10);
}

/// Share of the texels whose green exceeds their red and blue by a twelfth of their sum.
double green_share(const Texture& texture) {
  int green = 0;
  for (auto it = texture.rgba.begin<cv::Vec4b>(); it != texture.rgba.end<cv::Vec4b>(); ++it) {
    const int r = (*it)[0], g = (*it)[1], b = (*it)[2];
    green += 12 * (2 * g - r - b) > r + g + b ? 1 : 0;
  }
  return green / static_cast<double>(texture.rgba.total());
}

TEST(GroundTexturesTest, WhatWithersIsNoLongerGreen) {
  const double fresh = green_share(grass_texture(1, 0));
  EXPECT_GT(fresh, 0.9);
  EXPECT_LT(green_share(grass_texture(1, 0.5)), 0.8 * fresh);
  EXPECT_EQ(green_share(grass_texture(1, 1)), 0);
}

}  // namespace
}  // namespace vinebench::sim
