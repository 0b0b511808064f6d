// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/patches/warped_window.h"

#include <bit>

// This file is compiled once for each kind of vectors; the processor's is chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slam/patches/warped_window.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vinebench::slam::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Four neighbours of each place are read as one word and taken apart. No product is fused with a
/// sum, which would round otherwise.
template <class D, class V = hn::Vec<D>>
V cubic(D d, const std::uint8_t* row, V x) {
  const hn::RebindToSigned<D> words;
  const auto whole = hn::ConvertTo(words, x);
  const auto word = hn::GatherOffset(words, reinterpret_cast<const std::int32_t*>(row - 1), whole);
  const auto byte = hn::Set(words, 255);
  const auto a = hn::ConvertTo(d, hn::And(word, byte));
  const auto b = hn::ConvertTo(d, hn::And(hn::ShiftRight<8>(word), byte));
  const auto c = hn::ConvertTo(d, hn::And(hn::ShiftRight<16>(word), byte));
  const auto e = hn::ConvertTo(d, hn::And(hn::ShiftRight<24>(word), byte));
  const auto f = hn::Sub(x, hn::ConvertTo(d, whole));
  const auto times = [&](float factor, V v) { return hn::Mul(hn::Set(d, factor), v); };
  const auto third = hn::Sub(hn::Add(times(3, hn::Sub(b, c)), e), a);
  const auto second = hn::Sub(hn::Add(hn::Sub(times(2, a), times(5, b)), times(4, c)), e);
  const auto slope = hn::Add(hn::Sub(c, a), hn::Mul(f, hn::Add(second, hn::Mul(f, third))));
  return hn::Add(b, hn::Mul(times(0.5F, f), slope));
}

/// Differences at as many columns as `d` has lanes.
template <class D>
void warp_lanes(D d, const std::uint8_t* row, float centre, float scale, const float* columns,
                const float* window, float* difference) {
  const auto x = hn::Add(hn::Set(d, centre), hn::Mul(hn::Set(d, scale), hn::LoadU(d, columns)));
  hn::StoreU(hn::Sub(cubic(d, row, x), hn::LoadU(d, window)), d, difference);
}

void warp(const std::uint8_t* centre_row, std::ptrdiff_t step, const WindowWarp& warp,
          const float* window, float* difference) {
  // A window's twelve columns are eight and four, where there are eight lanes.
  const hn::CappedTag<float, 8> wide;
  const hn::CappedTag<float, 4> narrow;
  // The last one is that of the window's last pixel once more.
  constexpr float kColumns[kWindowPitch] = {-5, -4, -3, -2, -1, 0, 1, 2, 3, 4, 5, 5};
  static_assert(kAlignedRadius == 5);
  const float scale = 1 + warp.along_x;
  for (int dy = -kAlignedRadius; dy <= kAlignedRadius; ++dy) {
    const float centre = warp.x + warp.along_y * static_cast<float>(dy);
    const std::uint8_t* row = centre_row + dy * step;
    std::size_t k = 0;
    for (; k + hn::Lanes(wide) <= kWindowPitch; k += hn::Lanes(wide)) {
      warp_lanes(wide, row, centre, scale, kColumns + k, window + k, difference + k);
    }
    for (; k < kWindowPitch; k += hn::Lanes(narrow)) {
      warp_lanes(narrow, row, centre, scale, kColumns + k, window + k, difference + k);
    }
    window += kWindowPitch;
    difference += kWindowPitch;
  }
}

}  // namespace vinebench::slam::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vinebench::slam {

HWY_EXPORT(warp);

static_assert(std::endian::native == std::endian::little);

void warped_difference(const std::uint8_t* centre_row, std::ptrdiff_t step, const WindowWarp& warp,
                       const PitchedWindow& window, PitchedWindow& difference) {
  HWY_DYNAMIC_DISPATCH(warp)(centre_row, step, warp, window.data(), difference.data());
}

}  // namespace vinebench::slam
#endif
