// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace vinebench::slam {

inline constexpr int kAlignedRadius = 5;
inline constexpr int kAlignedSide = 2 * kAlignedRadius + 1;
/// Rows of a window lie one more pixel apart than they have, a round number for the processor; what
/// stands there does not count.
inline constexpr int kWindowPitch = 12;
using PitchedWindow = std::array<float, static_cast<std::size_t>(kAlignedSide* kWindowPitch)>;

/// Where each pixel of an aligned window is sampled: (1 + along_x) px apart from its neighbour, in
/// each row along_y px farther right than in the one above.
struct WindowWarp {
  float x = 0;  ///< px of the row, of the window's centre
  float along_x = 0;
  float along_y = 0;
};

/// Samples an image at the warped window, by cubic interpolation (Catmull-Rom) along its rows, less
/// `window`. `centre_row` is the first pixel of the row of the window's centre, whose neighbours
/// lie `step` bytes apart; the caller keeps two pixels to either side of what is sampled. The same
/// bits whatever the width of the processor's vectors.
void warped_difference(const std::uint8_t* centre_row, std::ptrdiff_t step, const WindowWarp& warp,
                       const PitchedWindow& window, PitchedWindow& difference);

}  // namespace vinebench::slam
