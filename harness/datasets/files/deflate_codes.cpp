// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/files/deflate_codes.h"

#include <libdeflate.h>

#include <algorithm>
#include <numeric>
#include <queue>

namespace vinebench::harness {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 20;  // bytes with codes of their own

using Lengths = std::array<std::uint8_t, kDeflateSymbols>;

/// Depths of Huffman's tree; ties go to the smaller node, so that the result is one.
Lengths huffman(const SymbolCounts& counts) {
  using Node = std::pair<std::uint64_t, int>;  // count, index
  std::priority_queue<Node, std::vector<Node>, std::greater<>> open;
  std::vector<int> parent(kDeflateSymbols, -1);
  for (int s = 0; s < kDeflateSymbols; ++s) {
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
  for (std::size_t s = 0; s < kDeflateSymbols; ++s) {
    if (counts[s] == 0) continue;
    for (int node = parent[s]; node >= 0; node = parent[static_cast<std::size_t>(node)]) {
      ++lengths[s];
    }
  }
  return lengths;
}

/// Code lengths of at most kMostCodeBits: the rarest symbols count more until it is so.
Lengths code_lengths(SymbolCounts counts) {
  const auto total = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  for (std::uint64_t least = total >> kMostCodeBits;; least += least / 2 + 1) {
    for (std::uint32_t& count : counts) {
      if (count > 0) count = std::max(count, static_cast<std::uint32_t>(least));
    }
    const Lengths lengths = huffman(counts);
    if (std::ranges::max(lengths) <= kMostCodeBits) return lengths;
  }
}

std::uint32_t reversed(std::uint32_t code, int bits) {
  std::uint32_t result = 0;
  for (int i = 0; i < bits; ++i) result |= (code >> i & 1) << (bits - 1 - i);
  return result;
}

}  // namespace

/// In the order of their lengths (RFC 1951, 3.2.2).
DeflateCodes::DeflateCodes(const SymbolCounts& counts) : lengths(code_lengths(counts)) {
  std::uint32_t code = 0;
  for (int bits = 1; bits <= kMostCodeBits; ++bits) {
    for (std::size_t s = 0; s < kDeflateSymbols; ++s) {
      if (lengths[s] == bits) codes[s] = reversed(code++, bits);
    }
    code <<= 1;
  }
}

/// The lengths of the codes, each in four bits, and one distance: that of the byte before.
void put_block_header(const DeflateCodes& codes, bool last, BitWriter& writer) {
  writer.put_now(last ? 1 : 0, 1);
  writer.put_now(2, 2);                      // codes of its own
  writer.put_now(kDeflateSymbols - 257, 5);  // lengths of literals and runs
  writer.put_now(0, 5);                      // one length of distances
  writer.put_now(15, 4);                     // all 19 lengths of lengths: 16, 17, 18 are not used
  for (int i = 0; i < 19; ++i) writer.put_now(i < 3 ? 0 : 4, 3);
  for (const std::uint8_t length : codes.lengths) writer.put_now(reversed(length, 4), 4);
  writer.put_now(reversed(1, 4), 4);
}

std::string_view zlib_stream(std::span<const std::uint8_t> bytes, const PutBlock& put_block,
                             std::vector<char>& buffer) {
  // No code is longer than kMostCodeBits, and a block's lengths take less than 256 bytes.
  const std::size_t blocks = std::max<std::size_t>(1, (bytes.size() + kBlock - 1) / kBlock);
  const std::size_t most = bytes.size() * kMostCodeBits / 8 + 256 * blocks + 64;
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
