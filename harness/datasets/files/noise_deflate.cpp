// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/files/noise_deflate.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <queue>

namespace vinebench::harness {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 20;  // bytes with codes of their own
constexpr std::size_t kStep = 4;                      // bytes from one look for a run to the next
constexpr std::size_t kSample = 4;                    // of so many steps one is counted
constexpr int kEnd = 256;                             // symbols of RFC 1951, 3.2.5
constexpr int kLongest = 285;
constexpr int kSymbols = 286;
constexpr std::size_t kLongestRun = 258;
constexpr int kMostBits = 13;  // of a code: four fit into a word of 64 bits beside 7 old ones

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

using Counts = std::array<std::uint32_t, kSymbols>;
using Lengths = std::array<std::uint8_t, kSymbols>;

/// Depths of Huffman's tree; ties go to the smaller node, so that the result is one.
Lengths huffman(const Counts& counts) {
  using Node = std::pair<std::uint64_t, int>;  // count, index
  std::priority_queue<Node, std::vector<Node>, std::greater<>> open;
  std::vector<int> parent(kSymbols, -1);
  for (int s = 0; s < kSymbols; ++s) {
    if (counts[static_cast<std::size_t>(s)] > 0) {
      open.emplace(counts[static_cast<std::size_t>(s)], s);
    }
  }
  while (open.size() > 1) {
    const Node a = open.top();
    open.pop();
    const Node b = open.top();
    open.pop();
    const auto joined = static_cast<int>(parent.size());
    parent.push_back(-1);
    for (const Node& node : {a, b}) parent[static_cast<std::size_t>(node.second)] = joined;
    open.emplace(a.first + b.first, joined);
  }
  Lengths lengths{};
  for (std::size_t s = 0; s < kSymbols; ++s) {
    if (counts[s] == 0) continue;
    for (int node = parent[s]; node >= 0; node = parent[static_cast<std::size_t>(node)]) {
      ++lengths[s];
    }
  }
  return lengths;
}

/// Code lengths of at most kMostBits: counts are evened out until it is so.
Lengths code_lengths(Counts counts) {
  for (;;) {
    const Lengths lengths = huffman(counts);
    if (std::ranges::max(lengths) <= kMostBits) return lengths;
    for (std::uint32_t& count : counts) count = count == 0 ? 0 : count / 2 + 1;
  }
}

std::uint32_t reversed(std::uint32_t code, int bits) {
  std::uint32_t result = 0;
  for (int i = 0; i < bits; ++i) result |= (code >> i & 1) << (bits - 1 - i);
  return result;
}

/// Codes in the order of their lengths (RFC 1951, 3.2.2), first bit lowest.
std::array<std::uint32_t, kSymbols> codes_of(const Lengths& lengths) {
  std::array<std::uint32_t, kSymbols> codes{};
  std::uint32_t code = 0;
  for (int bits = 1; bits <= kMostBits; ++bits) {
    for (std::size_t s = 0; s < kSymbols; ++s) {
      if (lengths[s] == bits) codes[s] = reversed(code++, bits);
    }
    code <<= 1;
  }
  return codes;
}

class BitWriter {
 public:
  explicit BitWriter(char* to) : to_(to) {}
  /// At most 57 bits with those that wait.
  void put(std::uint64_t bits, unsigned count) {
    word_ |= bits << count_;
    count_ += count;
  }
  void flush() {
    std::memcpy(to_, &word_, sizeof(word_));  // little-endian, as png_writer.cpp checks
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

/// The lengths of the codes, each in four bits, and one distance: that of the byte before.
void put_header(const Lengths& lengths, bool last, BitWriter& writer) {
  writer.put_now(last ? 1 : 0, 1);
  writer.put_now(2, 2);               // codes of its own
  writer.put_now(kSymbols - 257, 5);  // lengths of literals and runs
  writer.put_now(0, 5);               // one length of distances
  writer.put_now(15, 4);              // all 19 lengths of lengths: 16, 17 and 18 are not used
  for (int i = 0; i < 19; ++i) writer.put_now(i < 3 ? 0 : 4, 3);
  for (const std::uint8_t length : lengths) writer.put_now(reversed(length, 4), 4);
  writer.put_now(reversed(1, 4), 4);
}

/// How often about each symbol occurs; no less than once if it does.
Counts count_symbols(std::span<const std::uint8_t> bytes) {
  Counts counts{};
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
      [&] { ++counts[kLongest]; });
  for (std::size_t value = 0; value < occurs.size(); ++value) {
    for (const auto& table : tables) counts[value] += table[value];
    counts[value] = std::max<std::uint32_t>(counts[value] * kSample, occurs[value]);
  }
  counts[kEnd] = 1;
  counts[kLongest] += 1;  // a code has at least two symbols
  return counts;
}

/// The codes of two bytes at once, the first one lowest, above five bits with their length. Valid
/// until the thread's next call.
std::span<const std::uint32_t> codes_of_pairs(const std::array<std::uint32_t, kSymbols>& codes,
                                              const Lengths& lengths) {
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
  const Lengths lengths = code_lengths(count_symbols(bytes));
  const auto codes = codes_of(lengths);
  const std::uint32_t* const pairs = codes_of_pairs(codes, lengths).data();
  BitWriter writer = to;  // stays in registers: `to` might be what is written through its pointer
  put_header(lengths, last, writer);
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
        writer.put(codes[kLongest], lengths[kLongest]);
        writer.put_now(0, 1);
      });
  writer.put_now(codes[kEnd], lengths[kEnd]);
  to = writer;
}

}  // namespace

std::string_view deflate_noise(std::span<const std::uint8_t> bytes, std::vector<char>& buffer) {
  // No code is longer than kMostBits, and a block's lengths take less than 256 bytes.
  const std::size_t blocks = std::max<std::size_t>(1, (bytes.size() + kBlock - 1) / kBlock);
  const std::size_t most = bytes.size() * kMostBits / 8 + 256 * blocks + 64;
  if (buffer.size() < most) buffer.resize(most);
  buffer[0] = 0x78;
  buffer[1] = 0x01;
  BitWriter writer(buffer.data() + 2);
  for (std::size_t i = 0; i < blocks; ++i) {
    const std::size_t from = std::min(i * kBlock, bytes.size());
    const std::size_t count = std::min(kBlock, bytes.size() - from);
    put_block(bytes.subspan(from, count), i + 1 == blocks, writer);
  }
  char* end = writer.finish();
  const std::uint32_t check = libdeflate_adler32(1, bytes.data(), bytes.size());
  for (const int shift : {24, 16, 8, 0}) *end++ = static_cast<char>(check >> shift & 0xff);
  return {buffer.data(), static_cast<std::size_t>(end - buffer.data())};
}

}  // namespace vinebench::harness
