// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "sim/textures/textures.h"

namespace vinebench::sim {
namespace {

bool same(const Texture& a, const Texture& b) {
  return a.rgba.size() == b.rgba.size() && cv::norm(a.rgba, b.rgba, cv::NORM_INF) == 0;
}

TEST(PropTexturesTest, ASeedIsOneImage) {
  for (const auto make : {wood_texture, carton_texture, print_texture, cloth_texture}) {
    const Texture first = make(1);
    EXPECT_EQ(first.rgba.type(), CV_8UC4) << first.name;
    EXPECT_TRUE(same(first, make(1))) << first.name;
    EXPECT_FALSE(same(first, make(2))) << first.name;
  }
}

// The box's own colour multiplies it: white is the least change.
TEST(PropTexturesTest, ACartonsUpperHalfIsPlainAndPale) {
  const Texture carton = carton_texture(1);
  const cv::Mat upper = carton.rgba.rowRange(0, carton.rgba.rows / 2);
  const cv::Scalar mean = cv::mean(upper);
  for (int channel = 0; channel < 3; ++channel) EXPECT_GT(mean[channel], 150);
  EXPECT_FALSE(same(carton, print_texture(1)));
}

}  // namespace
}  // namespace vinebench::sim
