// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/files/run_deflate.h"

#include <gtest/gtest.h>
#include <libdeflate.h>

#include <memory>

#include "core/util/random.h"

namespace vinebench::harness {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// What libdeflate reads from the stream; a byte too many where that is none.
Bytes unpacked(std::string_view stream, std::size_t size) {
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> reader(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  Bytes bytes(size + 1);
  std::size_t count = 0;
  const auto result = libdeflate_zlib_decompress(reader.get(), stream.data(), stream.size(),
                                                 bytes.data(), bytes.size(), &count);
  bytes.resize(result == LIBDEFLATE_SUCCESS ? count : size + 1);
  return bytes;
}

void expect_same_back(const Bytes& bytes) {
  std::vector<char> buffer;
  EXPECT_EQ(unpacked(deflate_runs(bytes, buffer), bytes.size()), bytes) << bytes.size();
}

/// Runs of random values, of up to so many bytes.
Bytes areas(std::size_t count, double longest) {
  const RandomStream random(1, "areas");
  Bytes bytes;
  for (std::uint64_t i = 0; bytes.size() < count; i += 2) {
    const auto length = static_cast<std::size_t>(random.uniform(i, 1, longest + 1));
    bytes.insert(bytes.end(), std::min(length, count - bytes.size()),
                 static_cast<std::uint8_t>(random.uniform(i + 1, 0, 256)));
  }
  return bytes;
}

TEST(RunDeflateTest, BytesComeBack) {
  for (const std::size_t count : {0, 1, 2, 3, 8, 9, 10, 257, 100'000}) {
    for (const double longest : {1, 2, 3, 5, 12, 700}) expect_same_back(areas(count, longest));
  }
}

// A block has 2^20 bytes.
TEST(RunDeflateTest, BytesOfSeveralBlocksComeBack) {
  for (const int more : {-1, 0, 1}) expect_same_back(areas((1u << 21) + more, 40));
}

// Each length has its own symbol and bits; beyond 258 a run is several, or ends in single bytes.
TEST(RunDeflateTest, RunsOfAnyLengthComeBack) {
  for (std::size_t length = 1; length < 1100; ++length) {
    Bytes bytes = areas(7, 1);
    bytes.insert(bytes.end(), length, 9);
    bytes.push_back(3);
    expect_same_back(bytes);
    expect_same_back(Bytes(length, 0));
  }
}

// Of each four pieces of 4096 bytes the last three are not counted; their symbols have codes.
TEST(RunDeflateTest, WhatTheSampleMissesComesBack) {
  Bytes bytes(1 << 16, 0);
  for (std::size_t i = 5000; i < 16'000; ++i) bytes[i] = static_cast<std::uint8_t>(i * i >> 4);
  expect_same_back(bytes);
}

// 10,000 runs of eight bytes: each takes a literal and a run of seven. 256 equally likely literals
// are 8 bits and one more where half of the symbols are runs, which then are 1 bit; the distance
// is 1 bit: 11 bits. Bytes alone would be 64. The codes' lengths take less than 256 bytes, and
// symbols that never occur, but might, some of the codes: a tenth.
TEST(RunDeflateTest, ShortRunsAreShort) {
  Bytes bytes;
  for (std::size_t i = 0; i < 10'000; ++i) {
    bytes.insert(bytes.end(), 8, static_cast<std::uint8_t>(i * 77));
  }
  std::vector<char> buffer;
  EXPECT_LT(deflate_runs(bytes, buffer).size(), 10'000 * 11 / 8 * 1.1 + 256);
}

TEST(RunDeflateTest, OneValueTakesNextToNothing) {
  std::vector<char> buffer;
  EXPECT_LT(deflate_runs(Bytes(1'000'000, 3), buffer).size(), 3'000u);
}

}  // namespace
}  // namespace vinebench::harness
