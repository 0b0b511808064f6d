// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/row_search.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <vector>

namespace vinebench {
namespace {

constexpr int kWidth = 16;  // one SIMD register of grey levels
constexpr int kHalfWidth = kWidth / 2;
constexpr int kHalfHeight = 5;
constexpr int kNeighbourhood = 2;  ///< px about the best that are still the same minimum

int difference(const std::uint8_t* a, std::size_t a_step, const std::uint8_t* b,
               std::size_t b_step) {
  int sum = 0;
  for (int row = 0; row <= 2 * kHalfHeight; ++row, a += a_step, b += b_step) {
    int of_row = 0;
    for (int i = 0; i < kWidth; ++i) of_row += std::abs(a[i] - b[i]);
    sum += of_row;
  }
  return sum;
}

}  // namespace

RowSearch search_row(const cv::Mat& from, int x, int y, const cv::Mat& in, int first, int last) {
  first = std::max(first, kHalfWidth);
  last = std::min(last, in.cols - kHalfWidth);
  const bool on_picture = x >= kHalfWidth && x <= from.cols - kHalfWidth && y >= kHalfHeight &&
                          y < from.rows - kHalfHeight;
  if (!on_picture || first > last) return {};
  const std::uint8_t* window = from.ptr<std::uint8_t>(y - kHalfHeight) + x - kHalfWidth;
  const std::uint8_t* row = in.ptr<std::uint8_t>(y - kHalfHeight) - kHalfWidth;
  thread_local std::vector<int> sums;
  sums.resize(static_cast<std::size_t>(last - first + 1));
  for (int column = first; column <= last; ++column) {
    sums[static_cast<std::size_t>(column - first)] =
        difference(window, from.step[0], row + column, in.step[0]);
  }
  const auto least = std::min_element(sums.begin(), sums.end());
  RowSearch found{first + static_cast<int>(least - sums.begin()), *least,
                  std::numeric_limits<int>::max()};
  for (auto sum = sums.begin(); sum != sums.end(); ++sum) {
    if (std::abs(sum - least) > kNeighbourhood) found.second = std::min(found.second, *sum);
  }
  return found;
}

}  // namespace vinebench
