// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "sim/textures/textures.h"
#include "tests/support/same_texture.h"

namespace vinebench::sim {
namespace {

using test::same_texels;

TEST(PropTexturesTest, ASeedIsOneImage) {
  for (const auto make : {wood_texture, carton_texture, print_texture, cloth_texture}) {
    const Texture first = make(1);
    EXPECT_EQ(first.rgba.type(), CV_8UC4) << first.name;
    EXPECT_TRUE(same_texels(first, make(1))) << first.name;
    EXPECT_FALSE(same_texels(first, make(2))) << first.name;
  }
}

// The box's own colour multiplies it: white is the least change.
TEST(PropTexturesTest, ACartonsUpperHalfIsPlainAndPale) {
  const Texture carton = carton_texture(1);
  const cv::Mat upper = carton.rgba.rowRange(0, carton.rgba.rows / 2);
  const cv::Scalar mean = cv::mean(upper);
  for (int channel = 0; channel < 3; ++channel) EXPECT_GT(mean[channel], 150);
  EXPECT_FALSE(same_texels(carton, print_texture(1)));
}

}  // namespace
}  // namespace vinebench::sim
