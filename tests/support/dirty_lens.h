// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <opencv2/core.hpp>

namespace vinebench::test {

/// An image (CV_8UC1) through a lens with specks of grey dirt, 9 px apart, on the columns from
/// `first`: they are 90 % opaque in their middle.
inline cv::Mat through_dirt(const cv::Mat& image, int first = 0) {
  cv::Mat seen = image.clone();
  for (int y = 0; y < seen.rows; ++y) {
    auto* row = seen.ptr<std::uint8_t>(y);
    for (int x = first; x < seen.cols; ++x) {
      const double dirt = 0.9 * std::pow(std::sin(x * M_PI / 9) * std::sin(y * M_PI / 9), 2);
      row[x] = cv::saturate_cast<std::uint8_t>((1 - dirt) * row[x] + dirt * 128);
    }
  }
  return seen;
}

}  // namespace vinebench::test
