// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace vinebench::harness {

/// A zlib stream (RFC 1950, 1951) of bytes with many runs of one value, such as a filtered image of
/// labels: runs and Huffman codes, without a search for other repetitions. Valid as long as
/// `buffer`, which is overwritten.
std::string_view deflate_runs(std::span<const std::uint8_t> bytes, std::vector<char>& buffer);

}  // namespace vinebench::harness
