// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/features/smoothing.h"

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

// The rows are compiled once for each kind of vectors; the processor's is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slam/features/smoothing.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vinebench::slam::HWY_NAMESPACE {

constexpr int kRadius = 3;
constexpr int kWeightBits = 7;
/// exp(-k^2 / 8) from the middle outwards in 1/128; 28 + 2 (24 + 17 + 9) = 128.
constexpr std::array<std::uint16_t, kRadius + 1> kWeights{28, 24, 17, 9};

using Rows = std::array<const std::uint8_t*, 2 * kRadius + 1>;

/// Weighted sum of seven rows in 1/128 grey levels: at most 255 * 128, so that two fit 16 bits.
void sum_rows(const Rows& rows, int columns, std::uint16_t* sums) {
  const auto [a, b, c, d, e, f, g] = rows;
  for (int x = 0; x < columns; ++x) {
    sums[x] = static_cast<std::uint16_t>(kWeights[0] * d[x] + kWeights[1] * (c[x] + e[x]) +
                                         kWeights[2] * (b[x] + f[x]) + kWeights[3] * (a[x] + g[x]));
  }
}

/// The upper half of a product with weight << 9 is the product with weight / 128.
std::uint16_t weigh(std::uint16_t value, std::uint16_t weight) {
  const auto scaled = static_cast<std::uint16_t>(weight << (16 - kWeightBits));
  return static_cast<std::uint16_t>((std::uint32_t{value} * scaled) >> 16);
}

/// The same along the row. `sums` has kRadius more on either side.
void sum_columns(const std::uint16_t* sums, int columns, std::uint8_t* smoothed) {
  const auto pair = [](std::uint16_t a, std::uint16_t b) {
    return static_cast<std::uint16_t>(a + b);
  };
  for (int x = 0; x < columns; ++x) {
    const std::uint16_t* at = sums + x;
    const auto sum = static_cast<std::uint16_t>(
        weigh(at[0], kWeights[0]) + weigh(pair(at[-1], at[1]), kWeights[1]) +
        weigh(pair(at[-2], at[2]), kWeights[2]) + weigh(pair(at[-3], at[3]), kWeights[3]));
    smoothed[x] = static_cast<std::uint8_t>((sum + (1 << (kWeightBits - 1))) >> kWeightBits);
  }
}

}  // namespace vinebench::slam::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vinebench::slam {

HWY_EXPORT(sum_rows);
HWY_EXPORT(sum_columns);

namespace {

using HWY_NAMESPACE::kRadius;
using HWY_NAMESPACE::Rows;

int mirror(int i, int count) {
  return cv::borderInterpolate(i, count, cv::BORDER_REFLECT_101);
}

}  // namespace

cv::Mat smooth(const cv::Mat& image) {
  cv::Mat smoothed(image.size(), CV_8UC1);
  const int columns = image.cols;
  std::vector<std::uint16_t> padded(static_cast<std::size_t>(columns + 2 * kRadius));
  std::uint16_t* sums = padded.data() + kRadius;
  for (int y = 0; y < image.rows; ++y) {
    Rows rows;
    for (int i = -kRadius; i <= kRadius; ++i) {
      rows[static_cast<std::size_t>(i + kRadius)] =
          image.ptr<std::uint8_t>(mirror(y + i, image.rows));
    }
    HWY_DYNAMIC_DISPATCH(sum_rows)(rows, columns, sums);
    for (int i = 1; i <= kRadius; ++i) {
      sums[-i] = sums[mirror(-i, columns)];
      sums[columns - 1 + i] = sums[mirror(columns - 1 + i, columns)];
    }
    HWY_DYNAMIC_DISPATCH(sum_columns)(sums, columns, smoothed.ptr<std::uint8_t>(y));
  }
  return smoothed;
}

}  // namespace vinebench::slam
#endif
