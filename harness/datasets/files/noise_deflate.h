// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace vinebench::harness {

/// A zlib stream (RFC 1950, 1951) of bytes without repetitions, such as a filtered image of a noisy
/// sensor: Huffman codes alone, in which a search for repetitions would find little but takes most
/// of the time; runs of one byte are kept short. Valid as long as `buffer`, which is overwritten.
std::string_view deflate_noise(std::span<const std::uint8_t> bytes, std::vector<char>& buffer);

}  // namespace vinebench::harness
