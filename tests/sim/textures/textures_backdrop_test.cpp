// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "sim/textures/textures.h"
#include "tests/support/same_texture.h"

namespace vinebench::sim {
namespace {

cv::Mat alpha_of(const Texture& texture) {
  cv::Mat alpha;
  cv::extractChannel(texture.rgba, alpha, 3);
  return alpha;
}

// Bushes have no gap at their feet and nothing but sky above their tops.
TEST(BackdropTexturesTest, AHedgeIsOpaqueBelowAndClearAbove) {
  const cv::Mat alpha = alpha_of(hedge_texture(1));
  EXPECT_EQ(cv::mean(alpha.row(alpha.rows - 1))[0], 255);
  EXPECT_LT(cv::mean(alpha.row(0))[0], 10);
}

TEST(BackdropTexturesTest, ASeedIsOneHedge) {
  const Texture first = hedge_texture(1, 0.3);
  EXPECT_TRUE(test::same_texels(first, hedge_texture(1, 0.3)));
  EXPECT_FALSE(test::same_texels(first, hedge_texture(2, 0.3)));
}

// Crowns without leaves let the sky through: less of the band from 4 to 7 m is covered.
TEST(BackdropTexturesTest, TreesAreBareInWinter) {
  const auto covered = [](const Texture& hedge) {
    const cv::Mat alpha = alpha_of(hedge);
    const auto row = [&](double height) {
      const double share = kWallInset + (1 - 2 * kWallInset) * height / kHedgeTop;
      return static_cast<int>(alpha.rows * (1 - share));
    };
    return cv::mean(alpha.rowRange(row(7), row(4)))[0];
  };
  EXPECT_LT(covered(hedge_texture(1, 0.7)), 0.8 * covered(hedge_texture(1, 0.1)));
}

}  // namespace
}  // namespace vinebench::sim
