// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/files/run_deflate.h"

#include <algorithm>
#include <array>
#include <bit>

#include "harness/datasets/files/deflate_codes.h"

namespace vinebench::harness {
namespace {

constexpr std::size_t kPiece = 4096;  // bytes; of kSample pieces one is counted
constexpr std::size_t kSample = 4;

/// How a run's length is written (RFC 1951, 3.2.5): a symbol, and bits after it.
struct LengthSymbol {
  std::uint16_t symbol = 0;
  std::uint8_t extra_bits = 0;
  std::uint8_t extra = 0;
};

/// By the run's length. Symbols have 1, 1, 2, 4, 8, 16 and 32 lengths, four each from 11 on, eight
/// in the first group; 258 has one of its own.
constexpr std::array<LengthSymbol, kLongestRun + 1> length_symbols() {
  std::array<LengthSymbol, kLongestRun + 1> table{};
  std::size_t length = kShortestRun;
  for (std::uint16_t symbol = 257; symbol < kDeflateLongest; ++symbol) {
    const int bits = symbol < 265 ? 0 : (symbol - 261) / 4;
    for (int extra = 0; extra < 1 << bits && length < kLongestRun; ++extra, ++length) {
      table[length] = {symbol, static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(extra)};
    }
  }
  table[kLongestRun] = {kDeflateLongest, 0, 0};
  return table;
}

constexpr std::array<LengthSymbol, kLongestRun + 1> kLengths = length_symbols();

std::uint64_t load(const std::uint8_t* p) {
  std::uint64_t word = 0;
  std::memcpy(&word, p, sizeof(word));
  return word;
}

/// How many bytes from `at` on, at most eight, are as the one before each.
std::size_t repeated(std::span<const std::uint8_t> bytes, std::size_t at) {
  const std::uint8_t* const p = bytes.data() + at;
  if (at + 8 <= bytes.size()) {
    const std::uint64_t different = load(p) ^ load(p - 1);
    return static_cast<std::size_t>(std::countr_zero(different)) / 8;  // 64 bits of zeros: eight
  }
  std::size_t count = 0;
  while (at + count < bytes.size() && p[count] == p[count - 1]) ++count;
  return count;
}

/// Hands single bytes and lengths of runs of the byte before to the caller. The first byte is no
/// part of a run.
template <class Literal, class Run>
void scan(std::span<const std::uint8_t> bytes, const Literal& literal, const Run& run) {
  if (bytes.empty()) return;
  literal(bytes[0]);
  std::size_t i = 1;
  while (i < bytes.size()) {
    const std::size_t equal = repeated(bytes, i);
    if (equal < kShortestRun) {
      const std::size_t end = std::min(i + equal + 1, bytes.size());
      for (; i < end; ++i) literal(bytes[i]);
      continue;
    }
    std::size_t length = equal;
    for (std::size_t more = equal; more == 8;) {
      more = i + length < bytes.size() ? repeated(bytes, i + length) : 0;
      length += more;
    }
    const std::uint8_t value = bytes[i];
    i += length;
    while (length >= kShortestRun) {
      const std::size_t part = std::min(length, kLongestRun);
      run(part);
      length -= part;
    }
    for (; length > 0; --length) literal(value);
  }
}

/// Of a sample; each symbol at least once, for those that it misses.
SymbolCounts count_symbols(std::span<const std::uint8_t> bytes) {
  SymbolCounts counts;
  counts.fill(1);
  for (std::size_t from = 0; from < bytes.size(); from += kSample * kPiece) {
    scan(
        bytes.subspan(from, std::min(kPiece, bytes.size() - from)),
        [&](std::uint8_t byte) { counts[byte] += kSample; },
        [&](std::size_t length) { counts[kLengths[length].symbol] += kSample; });
  }
  return counts;
}

/// What is put for a byte or a run.
struct Bits {
  std::uint32_t bits = 0;
  std::uint32_t count = 0;
};

void put_block(std::span<const std::uint8_t> bytes, bool last, BitWriter& to) {
  const DeflateCodes codes(count_symbols(bytes));
  std::array<Bits, 256> literals;
  for (std::size_t i = 0; i < literals.size(); ++i)
    literals[i] = {codes.codes[i], codes.lengths[i]};
  std::array<Bits, kLongestRun + 1> runs{};
  for (std::size_t i = kShortestRun; i < runs.size(); ++i) {
    const LengthSymbol& length = kLengths[i];
    const std::uint32_t bits = codes.lengths[length.symbol];
    // The distance's code is one bit, zero.
    runs[i] = {codes.codes[length.symbol] | static_cast<std::uint32_t>(length.extra) << bits,
               bits + length.extra_bits + 1};
  }
  BitWriter writer = to;
  put_block_header(codes, last, writer);
  scan(
      bytes, [&](std::uint8_t byte) { writer.put_now(literals[byte].bits, literals[byte].count); },
      [&](std::size_t length) { writer.put_now(runs[length].bits, runs[length].count); });
  writer.put_now(codes.codes[kDeflateEnd], codes.lengths[kDeflateEnd]);
  to = writer;
}

}  // namespace

std::string_view deflate_runs(std::span<const std::uint8_t> bytes, std::vector<char>& buffer) {
  return zlib_stream(bytes, put_block, buffer);
}

}  // namespace vinebench::harness
