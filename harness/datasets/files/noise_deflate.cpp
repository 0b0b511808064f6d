// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/files/noise_deflate.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "harness/datasets/files/deflate_codes.h"

namespace vinebench::harness {
namespace {

constexpr std::size_t kStep = 4;    // bytes from one look for a run to the next
constexpr std::size_t kSample = 4;  // of so many steps one is counted

template <class Word>
Word load(const std::uint8_t* p) {
  Word word = 0;
  std::memcpy(&word, p, sizeof(word));
  return word;
}

/// Hands literals, kStep at a time where they are no run, and runs of the byte before to the
/// caller. The first byte of `bytes` is no part of a run.
template <class Literals, class Run>
void scan(std::span<const std::uint8_t> bytes, const Literals& literals, const Run& run) {
  const std::uint8_t* const data = bytes.data();
  std::size_t i = 0;
  while (i + kStep <= bytes.size()) {
    if (i == 0 || i + 8 > bytes.size() ||
        load<std::uint64_t>(data + i) != load<std::uint64_t>(data + i - 1)) {
      literals(data + i, kStep);
      i += kStep;
      continue;
    }
    std::size_t length = 8;
    const std::uint64_t eight = data[i] * 0x0101010101010101U;
    while (i + length + 8 <= bytes.size() && load<std::uint64_t>(data + i + length) == eight) {
      length += 8;
    }
    while (i + length < bytes.size() && data[i + length] == data[i - 1]) ++length;
    i += length;
    for (; length >= kLongestRun; length -= kLongestRun) run();
    for (std::size_t rest = length; rest > 0; rest -= std::min(rest, kStep)) {
      literals(data + i - rest, std::min(rest, kStep));
    }
  }
  if (i < bytes.size()) literals(data + i, bytes.size() - i);
}

/// How often about each symbol occurs; no less than once if it does.
SymbolCounts count_symbols(std::span<const std::uint8_t> bytes) {
  SymbolCounts counts{};
  std::array<std::uint8_t, 256> occurs{};
  // Four tables, so that equal neighbours do not wait for each other.
  std::array<std::array<std::uint32_t, 256>, kStep> tables{};
  std::size_t step = 0;
  scan(
      bytes,
      [&](const std::uint8_t* p, std::size_t n) {
        for (std::size_t i = 0; i < n; ++i) occurs[p[i]] = 1;
        if (step++ % kSample != 0) return;
        for (std::size_t i = 0; i < n; ++i) ++tables[i][p[i]];
      },
      [&] { ++counts[kDeflateLongest]; });
  for (std::size_t value = 0; value < occurs.size(); ++value) {
    for (const auto& table : tables) counts[value] += table[value];
    counts[value] = std::max<std::uint32_t>(counts[value] * kSample, occurs[value]);
  }
  counts[kDeflateEnd] = 1;
  counts[kDeflateLongest] += 1;  // a code has at least two symbols
  return counts;
}

/// The codes of two bytes at once, the first one lowest, above five bits with their length. Valid
/// until the thread's next call.
std::span<const std::uint32_t> codes_of_pairs(const DeflateCodes& table) {
  const auto& [lengths, codes] = table;
  thread_local std::vector<std::uint32_t> pairs(1 << 16);
  for (std::size_t second = 0; second < 256; ++second) {
    for (std::size_t first = 0; first < 256; ++first) {
      const std::uint32_t both = codes[first] | codes[second] << lengths[first];
      const auto length = static_cast<std::uint32_t>(lengths[first] + lengths[second]);
      pairs[second << 8 | first] = both << 5 | length;
    }
  }
  return pairs;
}

void put_block(std::span<const std::uint8_t> bytes, bool last, BitWriter& to) {
  const DeflateCodes table(count_symbols(bytes));
  const auto& lengths = table.lengths;
  const auto& codes = table.codes;
  const std::uint32_t* const pairs = codes_of_pairs(table).data();
  BitWriter writer = to;
  put_block_header(table, last, writer);
  scan(
      bytes,
      [&](const std::uint8_t* p, std::size_t n) {
        if (n == kStep) {
          const auto four = load<std::uint32_t>(p);
          for (const std::uint32_t pair : {pairs[four & 0xffff], pairs[four >> 16]}) {
            writer.put(pair >> 5, pair & 31);
          }
        } else {
          for (std::size_t i = 0; i < n; ++i) writer.put(codes[p[i]], lengths[p[i]]);
        }
        writer.flush();
      },
      [&] {
        writer.put(codes[kDeflateLongest], lengths[kDeflateLongest]);
        writer.put_now(0, 1);
      });
  writer.put_now(codes[kDeflateEnd], lengths[kDeflateEnd]);
  to = writer;
}

}  // namespace

std::string_view deflate_noise(std::span<const std::uint8_t> bytes, std::vector<char>& buffer) {
  return zlib_stream(bytes, put_block, buffer);
}

}  // namespace vinebench::harness
