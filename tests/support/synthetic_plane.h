// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include "tests/support/synthetic_texture.h"

namespace vinebench::test {

/// A textured plane in front of a rectified pair. In the left image its disparity is linear: d(x,
/// y) = at_middle + by_x (x - middle) + by_y (y - middle), px.
struct SyntheticPlane {
  double at_middle = 20;
  double by_x = 0;  ///< px of disparity a px
  double by_y = 0;
  int width = 480;
  int height = 200;
  std::uint64_t texture = 11;

  double disparity(double x, double y) const {
    return at_middle + by_x * (x - width / 2.0) + by_y * (y - height / 2.0);
  }
  double left_grey(double x, double y) const { return SyntheticTexture(texture)(x, y); }
  /// The right camera sees at x what the left one sees at x + d: solved for the left column.
  double right_grey(double x, double y) const {
    return left_grey((x + disparity(0, y)) / (1 - by_x), y);
  }
  cv::Mat left(double sigma) const {
    return render_image(
        width, height, [this](double x, double y) { return left_grey(x, y); }, sigma, 1);
  }
  cv::Mat right(double sigma) const {
    return render_image(
        width, height, [this](double x, double y) { return right_grey(x, y); }, sigma, 2);
  }
};

}  // namespace vinebench::test
