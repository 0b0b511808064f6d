// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/row_search.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

namespace vinebench {
namespace {

constexpr int kWidth = 16;  // one SIMD register of grey levels
constexpr int kHalfWidth = kWidth / 2;
constexpr int kHalfHeight = 5;
constexpr int kNeighbourhood = 2;  ///< px about the best that are still the same minimum

/// Every other row of the window is summed everywhere; the rest only where that sum leaves hope.
constexpr std::array kFirstRows{-4, -2, 0, 2, 4};
constexpr std::array kOtherRows{-5, -3, -1, 1, 3, 5};

/// A window's rows, and those of the picture that it is looked for in, at their first pixels.
struct Strip {
  const std::uint8_t* window;  ///< of the middle row
  std::size_t window_step;
  const std::uint8_t* row;  ///< of the middle row, for column 0
  std::size_t row_step;
};

template <std::size_t N>
std::array<const std::uint8_t*, N> rows_at(const std::uint8_t* middle, std::size_t step,
                                           const std::array<int, N>& rows) {
  std::array<const std::uint8_t*, N> at;
  for (std::size_t i = 0; i < N; ++i) {
    at[i] = middle + static_cast<std::ptrdiff_t>(step) * rows[i];
  }
  return at;
}

/// Sums of absolute differences over `rows` with the window's centre in `first` and the `count - 1`
/// columns after it.
template <std::size_t N>
void differences(const Strip& strip, const std::array<int, N>& rows, int first, int count,
                 int* sums) {
  const auto a = rows_at(strip.window, strip.window_step, rows);
  const auto b = rows_at(strip.row + first, strip.row_step, rows);
#if defined(__SSE2__)
  const auto load = [](const std::uint8_t* p) {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
  };
  __m128i window[N];
  for (std::size_t i = 0; i < N; ++i) window[i] = load(a[i]);
  for (int column = 0; column < count; ++column) {
    __m128i sum = _mm_setzero_si128();
    for (std::size_t i = 0; i < N; ++i) {
      sum = _mm_add_epi64(sum, _mm_sad_epu8(window[i], load(b[i] + column)));
    }
    sums[column] = _mm_cvtsi128_si32(_mm_add_epi64(sum, _mm_srli_si128(sum, 8)));
  }
#else
  for (int column = 0; column < count; ++column) {
    sums[column] = 0;
    for (std::size_t i = 0; i < N; ++i) {
      for (int k = 0; k < kWidth; ++k) sums[column] += std::abs(a[i][k] - b[i][column + k]);
    }
  }
#endif
}

/// The sums along a row, completed where they are asked for.
class Sums {
 public:
  Sums(const Strip& strip, int first, int last) : strip_(strip), first_(first), sums_(scratch()) {
    sums_.resize(static_cast<std::size_t>(last - first + 1));
    differences(strip_, kFirstRows, first, static_cast<int>(sums_.size()), sums_.data());
  }
  int size() const { return static_cast<int>(sums_.size()); }
  int at_least(int i) const { return sums_[static_cast<std::size_t>(i)]; }
  int whole(int i) const {
    int rest = 0;
    differences(strip_, kOtherRows, first_ + i, 1, &rest);
    return at_least(i) + rest;
  }

 private:
  static std::vector<int>& scratch() {
    thread_local std::vector<int> sums;
    return sums;
  }
  const Strip strip_;
  const int first_;
  std::vector<int>& sums_;
};

/// The first least sum, and where.
std::pair<int, int> find_best(const Sums& sums) {
  int hope = 0;
  for (int i = 1; i < sums.size(); ++i) hope = sums.at_least(i) < sums.at_least(hope) ? i : hope;
  int best = sums.whole(hope);
  int at = hope;
  for (int i = 0; i < sums.size(); ++i) {
    if (i == hope || sums.at_least(i) > best) continue;
    const int sum = sums.whole(i);
    if (sum > best || (sum == best && i > at)) continue;
    best = sum;
    at = i;
  }
  return {best, at};
}

/// The least sum outside of the best's neighbourhood, where it is below `limit`.
int find_rival(const Sums& sums, int best_at, double limit) {
  int rival = std::numeric_limits<int>::max();
  for (int i = 0; i < sums.size(); ++i) {
    if (sums.at_least(i) >= std::min<double>(rival, limit)) continue;
    if (std::abs(i - best_at) > kNeighbourhood) rival = std::min(rival, sums.whole(i));
  }
  return rival < limit ? rival : std::numeric_limits<int>::max();
}

}  // namespace

RowSearch search_row(const cv::Mat& from, int x, int y, const cv::Mat& in, int first, int last,
                     double rivalry) {
  first = std::max(first, kHalfWidth);
  last = std::min(last, in.cols - kHalfWidth);
  const bool on_picture = x >= kHalfWidth && x <= from.cols - kHalfWidth && y >= kHalfHeight &&
                          y < from.rows - kHalfHeight;
  if (!on_picture || first > last) return {};
  const Strip strip{from.ptr<std::uint8_t>(y) + x - kHalfWidth, from.step[0],
                    in.ptr<std::uint8_t>(y) - kHalfWidth, in.step[0]};
  const Sums sums(strip, first, last);
  const auto [best, at] = find_best(sums);
  return {first + at, best, find_rival(sums, at, rivalry * best + 1)};
}

}  // namespace vinebench
