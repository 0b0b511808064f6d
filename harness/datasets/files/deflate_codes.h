// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace vinebench::harness {

/// What the writers of compressed data (RFC 1951) have in common: they differ in how they find
/// runs. The only distance is that of the byte before.

inline constexpr int kDeflateSymbols = 286;  ///< bytes, the end, lengths of runs (3.2.5)
inline constexpr int kDeflateEnd = 256;
inline constexpr int kDeflateLongest = 285;  ///< a run of kLongestRun
inline constexpr std::size_t kShortestRun = 3;
inline constexpr std::size_t kLongestRun = 258;

/// Of a code of ours: four fit into a word of 64 bits beside 7 old ones.
inline constexpr int kMostCodeBits = 13;

using SymbolCounts = std::array<std::uint32_t, kDeflateSymbols>;

/// Huffman's codes of the symbols that occur, the first bit lowest.
struct DeflateCodes {
  explicit DeflateCodes(const SymbolCounts& counts);
  std::array<std::uint8_t, kDeflateSymbols> lengths{};
  std::array<std::uint32_t, kDeflateSymbols> codes{};
};

/// Puts bits into memory that is large enough, and has eight bytes more. Keep it in registers: a
/// copy of one that is reached by a reference, which might be what is written to.
class BitWriter {
 public:
  explicit BitWriter(char* to) : to_(to) {
    static_assert(std::endian::native == std::endian::little, "words are written as they are");
  }
  /// At most 57 bits with those that wait.
  void put(std::uint64_t bits, unsigned count) {
    word_ |= bits << count_;
    count_ += count;
  }
  void flush() {
    std::memcpy(to_, &word_, sizeof(word_));
    to_ += count_ / 8;
    word_ >>= count_ / 8 * 8;
    count_ %= 8;
  }
  void put_now(std::uint64_t bits, unsigned count) {
    put(bits, count);
    flush();
  }
  char* finish() {
    put_now(0, (8 - count_) % 8);
    return to_;
  }

 private:
  char* to_;
  std::uint64_t word_ = 0;
  unsigned count_ = 0;
};

/// The head of a block with codes of its own.
void put_block_header(const DeflateCodes& codes, bool last, BitWriter& writer);

/// Writes a block: its bytes, whether it is the last.
using PutBlock = std::function<void(std::span<const std::uint8_t>, bool, BitWriter&)>;

/// A zlib stream (RFC 1950) of the bytes in blocks. Valid as long as `buffer`, which is
/// overwritten.
std::string_view zlib_stream(std::span<const std::uint8_t> bytes, const PutBlock& put_block,
                             std::vector<char>& buffer);

}  // namespace vinebench::harness
