// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/stereo/row_search.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

namespace vinebench::slam {
namespace {

constexpr int kWidth = 16;  // one SIMD register of grey levels
constexpr int kHalfWidth = kWidth / 2;
constexpr int kHalfHeight = 5;
constexpr int kNeighbourhood = 2;  ///< px about the best that are still the same minimum

/// Every other row of the window is summed everywhere; the rest only where that sum leaves hope.
constexpr std::array kFirstRows{-4, -2, 0, 2, 4};
constexpr std::array kOtherRows{-5, -3, -1, 1, 3, 5};

/// A window's rows, and those of the image that it is looked for in, at their first pixels.
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

/// A column that may be the best or its rival.
struct Candidate {
  int column;
  int sum;
};

/// Every column whose sum is at most the best one's or below `rivalry` times that, with those sums,
/// and perhaps some more.
const std::vector<Candidate>& find_candidates(const Strip& strip, int first, int last,
                                              double rivalry) {
  thread_local std::vector<int> sums;
  thread_local std::vector<Candidate> candidates;
  sums.resize(static_cast<std::size_t>(last - first + 1));
  differences(strip, kFirstRows, first, static_cast<int>(sums.size()), sums.data());
  const auto complete = [&](int column) {
    int rest = 0;
    differences(strip, kOtherRows, column, 1, &rest);
    return sums[static_cast<std::size_t>(column - first)] + rest;
  };
  int least = sums[0];
  for (const int sum : sums) least = std::min(least, sum);
  const auto hope = std::find(sums.begin(), sums.end(), least) - sums.begin();
  // The best is no worse than the most hopeful.
  const double reach = std::max(1.0, rivalry) * complete(first + static_cast<int>(hope));
  const int limit = static_cast<int>(std::min<double>(reach, std::numeric_limits<int>::max()));
  candidates.clear();
  for (int column = first; column <= last; ++column) {
    if (sums[static_cast<std::size_t>(column - first)] > limit) continue;
    candidates.push_back({column, complete(column)});
  }
  return candidates;
}

}  // namespace

RowSearch search_row(const cv::Mat& from, int x, int y, const cv::Mat& in, int first, int last,
                     double rivalry) {
  first = std::max(first, kHalfWidth);
  last = std::min(last, in.cols - kHalfWidth);
  const bool on_image = x >= kHalfWidth && x <= from.cols - kHalfWidth && y >= kHalfHeight &&
                        y < from.rows - kHalfHeight;
  if (!on_image || first > last) return {};
  const Strip strip{from.ptr<std::uint8_t>(y) + x - kHalfWidth, from.step[0],
                    in.ptr<std::uint8_t>(y) - kHalfWidth, in.step[0]};
  const std::vector<Candidate>& candidates = find_candidates(strip, first, last, rivalry);
  const auto less = [](const Candidate& a, const Candidate& b) { return a.sum < b.sum; };
  const Candidate best = *std::min_element(candidates.begin(), candidates.end(), less);
  RowSearch found{best.column, best.sum, std::numeric_limits<int>::max()};
  for (const Candidate& other : candidates) {
    const bool rival = std::abs(other.column - best.column) > kNeighbourhood;
    if (rival && other.sum <= rivalry * best.sum) found.second = std::min(found.second, other.sum);
  }
  return found;
}

}  // namespace vinebench::slam
