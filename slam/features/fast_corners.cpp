// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/features/fast_corners.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

// This file is compiled once for each kind of vectors; the processor's is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slam/features/fast_corners.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vinebench::slam::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kCircle = 16;
constexpr std::size_t kPairs = kCircle / 2;
using CircleOffsets = std::array<std::ptrdiff_t, kCircle>;
/// At most as many as the bits of a word.
using Lanes = hn::CappedTag<std::uint8_t, 64>;

/// Of the circle's pixels, in order, in an image whose rows are `step` bytes apart.
CircleOffsets circle_offsets(std::ptrdiff_t step) {
  return {-3 * step,    -3 * step + 1, -2 * step + 2, -step + 3,    3,        step + 3,
          2 * step + 2,                                                            //
          3 * step + 1, 3 * step,      3 * step - 1,  2 * step - 2, step - 3, -3,  //
          -step - 3,    -2 * step - 2, -3 * step - 1};
}

/// The largest difference that nine in a row all reach. The two runs that begin with a pair and
/// before it share eight pixels: these, and the larger one of their neighbours.
template <class V>
V reached_by_nine(const V* difference) {
  V two[kPairs];
  V four[kPairs];
  for (std::size_t i = 0; i < kPairs; ++i) {
    two[i] = hn::Min(difference[2 * i], difference[2 * i + 1]);
  }
  for (std::size_t i = 0; i < kPairs; ++i) four[i] = hn::Min(two[i], two[(i + 1) % kPairs]);
  V best = hn::Xor(two[0], two[0]);
  for (std::size_t i = 0; i < kPairs; ++i) {
    const V eight = hn::Min(four[i], four[(i + 2) % kPairs]);
    const V ninth =
        hn::Max(difference[(2 * i + kCircle - 1) % kCircle], difference[(2 * i + 8) % kCircle]);
    best = hn::Max(best, hn::Min(eight, ninth));
  }
  return best;
}

/// Scores of neighbouring pixels of a row; 0 where they are below `least`.
template <class D>
void score_lanes(D d, const std::uint8_t* at, const CircleOffsets& offsets, std::uint8_t least,
                 std::uint8_t* scores) {
  const auto centre = hn::LoadU(d, at);
  const auto limit = hn::Set(d, least);
  // Nine in a row have one at least of every two that are opposite.
  auto brighter = hn::Set(d, 255);
  auto darker = brighter;
  for (std::size_t i = 0; i < kPairs; i += 2) {
    const auto a = hn::LoadU(d, at + offsets[i]);
    const auto b = hn::LoadU(d, at + offsets[i + kPairs]);
    brighter = hn::Min(brighter, hn::SaturatedSub(hn::Max(a, b), centre));
    darker = hn::Min(darker, hn::SaturatedSub(centre, hn::Min(a, b)));
  }
  auto reached = hn::Zero(d);
  decltype(reached) difference[kCircle];
  if (!hn::AllFalse(d, hn::Gt(brighter, limit))) {
    for (std::size_t i = 0; i < kCircle; ++i) {
      difference[i] = hn::SaturatedSub(hn::LoadU(d, at + offsets[i]), centre);
    }
    reached = reached_by_nine(difference);
  }
  if (!hn::AllFalse(d, hn::Gt(darker, limit))) {
    for (std::size_t i = 0; i < kCircle; ++i) {
      difference[i] = hn::SaturatedSub(centre, hn::LoadU(d, at + offsets[i]));
    }
    reached = hn::Max(reached, reached_by_nine(difference));
  }
  // What is reached is above the highest threshold by one.
  const auto score = hn::SaturatedSub(reached, hn::Set(d, 1));
  hn::StoreU(hn::IfThenElseZero(hn::Gt(reached, limit), score), d, scores);
}

void score_row(const std::uint8_t* row, std::ptrdiff_t step, std::size_t count, std::uint8_t least,
               std::uint8_t* scores) {
  const Lanes wide;
  const hn::CappedTag<std::uint8_t, 1> single;
  const std::size_t lanes = hn::Lanes(wide);
  const CircleOffsets offsets = circle_offsets(step);
  std::size_t x = 0;
  for (; x + lanes <= count; x += lanes) score_lanes(wide, row + x, offsets, least, scores + x);
  if (x < count && count >= lanes) {  // the last ones, some of them once more
    x = count - lanes;
    score_lanes(wide, row + x, offsets, least, scores + x);
    return;
  }
  for (; x < count; ++x) score_lanes(single, row + x, offsets, least, scores + x);
}

/// Appends the columns from 0 on, `count` of them, whose score is above the eight around. A vector
/// may reach beyond them.
void find_maxima(const std::array<const std::uint8_t*, 3>& rows, std::size_t count, int x0, int y,
                 std::vector<Corner>& corners) {
  const Lanes d;
  for (std::size_t x = 0; x < count; x += hn::Lanes(d)) {
    const auto centre = hn::LoadU(d, rows[1] + x);
    if (hn::AllFalse(d, hn::Gt(centre, hn::Zero(d)))) continue;
    auto around = hn::Max(hn::LoadU(d, rows[1] + x - 1), hn::LoadU(d, rows[1] + x + 1));
    for (const std::uint8_t* row : {rows[0], rows[2]}) {
      const auto sides = hn::Max(hn::LoadU(d, row + x - 1), hn::LoadU(d, row + x + 1));
      around = hn::Max(around, hn::Max(sides, hn::LoadU(d, row + x)));
    }
    std::uint64_t bits = 0;
    std::array<std::uint8_t, 8> bytes{};
    hn::StoreMaskBits(d, hn::Gt(centre, around), bytes.data());
    std::memcpy(&bits, bytes.data(), sizeof bits);
    for (; bits != 0; bits &= bits - 1) {
      const std::size_t column = x + static_cast<std::size_t>(std::countr_zero(bits));
      if (column >= count) break;
      corners.push_back({x0 + static_cast<int>(column), y, rows[1][column]});
    }
  }
}

}  // namespace vinebench::slam::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vinebench::slam {

HWY_EXPORT(score_row);
HWY_EXPORT(find_maxima);

namespace {

static_assert(std::endian::native == std::endian::little);
/// Of the circle, px.
constexpr int kFastRadius = 3;
/// Beside a row of scores: a pixel to the left, and what a vector reaches beyond the last one.
constexpr std::size_t kFrame = 65;

/// Scores of three consecutive rows, and zeros around them.
class ScoreRows {
 public:
  ScoreRows(const cv::Mat& image, const cv::Rect& scored, int least)
      : image_(image), scored_(scored), least_(static_cast<std::uint8_t>(least)) {
    for (auto& row : rows_) row.assign(static_cast<std::size_t>(scored.width) + 2 * kFrame, 0);
  }

  /// Gives up the first row for that at `y`, which is zero where no pixel of it can be a corner.
  void next(int y) {
    std::rotate(rows_.begin(), rows_.begin() + 1, rows_.end());
    std::uint8_t* scores = rows_[2].data() + kFrame;
    const auto count = static_cast<std::size_t>(scored_.width);
    if (y < scored_.y || y >= scored_.y + scored_.height) {
      std::fill_n(scores, count, std::uint8_t{0});
      return;
    }
    HWY_DYNAMIC_DISPATCH(score_row)
    (image_.ptr<std::uint8_t>(y) + scored_.x, static_cast<std::ptrdiff_t>(image_.step[0]), count,
     least_, scores);
  }
  /// At the column `x` of the image.
  std::array<const std::uint8_t*, 3> at(int x) const {
    const auto from = kFrame + static_cast<std::size_t>(x - scored_.x);
    return {rows_[0].data() + from, rows_[1].data() + from, rows_[2].data() + from};
  }

 private:
  const cv::Mat& image_;
  cv::Rect scored_;
  std::uint8_t least_;
  std::array<std::vector<std::uint8_t>, 3> rows_;
};

}  // namespace

std::vector<Corner> fast_corners(const cv::Mat& image, const cv::Rect& area, int least) {
  std::vector<Corner> corners;
  const cv::Rect possible(kFastRadius, kFastRadius, image.cols - 2 * kFastRadius,
                          image.rows - 2 * kFastRadius);
  if (possible.width <= 0 || possible.height <= 0) return corners;
  const cv::Rect wanted = area & possible;
  if (wanted.empty()) return corners;
  const cv::Rect around(wanted.x - 1, wanted.y - 1, wanted.width + 2, wanted.height + 2);
  ScoreRows scores(image, around & possible, least);
  scores.next(wanted.y - 1);
  scores.next(wanted.y);
  for (int y = wanted.y; y < wanted.y + wanted.height; ++y) {
    scores.next(y + 1);
    HWY_DYNAMIC_DISPATCH(find_maxima)
    (scores.at(wanted.x), static_cast<std::size_t>(wanted.width), wanted.x, y, corners);
  }
  return corners;
}

}  // namespace vinebench::slam
#endif
