// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/patches/warped_window.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "tests/support/synthetic_texture.h"
#include "tests/support/vector_kinds.h"

namespace vinebench::slam {
namespace {

using test::render_image;
using test::SyntheticTexture;

constexpr int kRow = 20;

class WarpedWindow : public testing::Test {
 protected:
  PitchedWindow difference(const WindowWarp& warp, const PitchedWindow& window = {}) const {
    PitchedWindow result;
    warped_difference(image_.ptr<std::uint8_t>(kRow), static_cast<std::ptrdiff_t>(image_.step[0]),
                      warp, window, result);
    return result;
  }
  /// A grey level of the image at (x, kRow + dy) by the definition of Catmull and Rom's spline.
  double cubic(double x, int dy) const {
    const std::uint8_t* row = image_.ptr<std::uint8_t>(kRow + dy);
    const int i = static_cast<int>(std::floor(x));
    const double t = x - i;
    const double p[] = {double(row[i - 1]), double(row[i]), double(row[i + 1]), double(row[i + 2])};
    return 0.5 * (2 * p[1] + (p[2] - p[0]) * t + (2 * p[0] - 5 * p[1] + 4 * p[2] - p[3]) * t * t +
                  (3 * p[1] - p[0] - 3 * p[2] + p[3]) * t * t * t);
  }
  static std::size_t at(int dx, int dy) {
    return static_cast<std::size_t>((dy + kAlignedRadius) * kWindowPitch + dx + kAlignedRadius);
  }

  cv::Mat image_ = render_image(60, 40, SyntheticTexture(5));
};

TEST_F(WarpedWindow, InterpolatesAlongTheRows) {
  const WindowWarp warp{27.3F, 0.07F, -0.04F};
  const PitchedWindow found = difference(warp);
  for (int dy = -kAlignedRadius; dy <= kAlignedRadius; ++dy) {
    for (int dx = -kAlignedRadius; dx <= kAlignedRadius; ++dx) {
      const double x = 27.3 - 0.04 * dy + 1.07 * dx;
      // Floats of up to 255 and a place of up to 60 px err by 1e-5 each, times slopes below 100.
      EXPECT_NEAR(found[at(dx, dy)], cubic(x, dy), 2e-3) << dx << ", " << dy;
    }
  }
}

// At whole columns interpolation is the pixel itself.
TEST_F(WarpedWindow, OfWholeColumnsIsThePixels) {
  const PitchedWindow found = difference({30, 0, 0});
  for (int dy = -kAlignedRadius; dy <= kAlignedRadius; ++dy) {
    for (int dx = -kAlignedRadius; dx <= kAlignedRadius; ++dx) {
      EXPECT_EQ(found[at(dx, dy)], float(image_.at<std::uint8_t>(kRow + dy, 30 + dx)));
    }
  }
}

TEST_F(WarpedWindow, TakesTheWindowAway) {
  PitchedWindow window;
  for (std::size_t i = 0; i < window.size(); ++i) window[i] = static_cast<float>(i);
  const PitchedWindow plain = difference({30, 0, 0});
  const PitchedWindow less = difference({30, 0, 0}, window);
  for (std::size_t i = 0; i < window.size(); ++i) EXPECT_EQ(less[i], plain[i] - window[i]);
}

TEST_F(WarpedWindow, HasTheSameBitsWithEveryKindOfVectors) {
  const WindowWarp warp{31.37F, -0.03F, 0.11F};
  const PitchedWindow expected = difference(warp);
  test::with_each_kind_of_vectors([&] { EXPECT_EQ(difference(warp), expected); });
}

}  // namespace
}  // namespace vinebench::slam
