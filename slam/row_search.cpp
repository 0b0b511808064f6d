// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/row_search.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

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

#if defined(__SSE2__)
/// Sum of absolute differences of 16 grey levels, in the two halves of the register.
__m128i row_difference(const std::uint8_t* a, const std::uint8_t* b) {
  return _mm_sad_epu8(_mm_loadu_si128(reinterpret_cast<const __m128i*>(a)),
                      _mm_loadu_si128(reinterpret_cast<const __m128i*>(b)));
}

int difference(const std::uint8_t* a, std::size_t a_step, const std::uint8_t* b,
               std::size_t b_step) {
  __m128i sum = _mm_setzero_si128();
  for (int row = 0; row <= 2 * kHalfHeight; ++row, a += a_step, b += b_step) {
    sum = _mm_add_epi64(sum, row_difference(a, b));
  }
  return _mm_cvtsi128_si32(sum) + _mm_cvtsi128_si32(_mm_srli_si128(sum, 8));
}
#else
int difference(const std::uint8_t* a, std::size_t a_step, const std::uint8_t* b,
               std::size_t b_step) {
  int sum = 0;
  for (int row = 0; row <= 2 * kHalfHeight; ++row, a += a_step, b += b_step) {
    for (int i = 0; i < kWidth; ++i) sum += std::abs(a[i] - b[i]);
  }
  return sum;
}
#endif

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
