// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/files/noise_deflate.h"

#include <gtest/gtest.h>
#include <libdeflate.h>

#include <memory>
#include <utility>

#include "core/util/random.h"

namespace vinebench::harness {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// What libdeflate reads from the stream; a byte too many where that is none.
Bytes inflated(std::string_view stream, std::size_t size) {
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> reader(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  Bytes bytes(size + 1);
  std::size_t count = 0;
  const auto result = libdeflate_zlib_decompress(reader.get(), stream.data(), stream.size(),
                                                 bytes.data(), bytes.size(), &count);
  bytes.resize(result == LIBDEFLATE_SUCCESS ? count : size + 1);
  return bytes;
}

void expect_unchanged(const Bytes& bytes) {
  std::vector<char> buffer;
  EXPECT_EQ(inflated(deflate_noise(bytes, buffer), bytes.size()), bytes) << bytes.size();
}

Bytes noise(std::size_t count, double values) {
  const RandomStream random(1, "noise");
  Bytes bytes(count);
  for (std::size_t i = 0; i < count; ++i) {
    bytes[i] = static_cast<std::uint8_t>(random.uniform(i, 0, values));
  }
  return bytes;
}

TEST(NoiseDeflateTest, BytesComeBack) {
  for (const std::size_t count : {0, 1, 3, 4, 5, 257, 100'000}) {
    expect_unchanged(noise(count, 256));
    expect_unchanged(noise(count, 5));
  }
}

// A block has 2^20 bytes.
TEST(NoiseDeflateTest, BytesOfSeveralBlocksComeBack) {
  for (const int more : {-1, 0, 1}) expect_unchanged(noise((1u << 21) + more, 40));
}

TEST(NoiseDeflateTest, RunsOfAnyLengthComeBack) {
  for (std::size_t length = 1; length < 1100; ++length) {
    Bytes bytes = noise(7, 256);
    bytes.insert(bytes.end(), length, 9);
    bytes.push_back(3);
    expect_unchanged(bytes);
    expect_unchanged(Bytes(length, 0));
  }
}

// Counts like Fibonacci's numbers make the deepest tree: 24 symbols would have up to 23 bits.
TEST(NoiseDeflateTest, CodesOfALopsidedDistributionAreLimited) {
  Bytes bytes;
  for (std::size_t value = 0, one = 1, two = 1; value < 24; ++value) {
    bytes.insert(bytes.end(), one, static_cast<std::uint8_t>(value * 7));
    one = std::exchange(two, one + two);
  }
  expect_unchanged(bytes);
}

// 32 equally frequent values are 5 bits each; the codes' lengths take less than 256 bytes a block.
TEST(NoiseDeflateTest, TakesAsManyBitsAsTheNoiseHas) {
  std::vector<char> buffer;
  EXPECT_NEAR(static_cast<double>(deflate_noise(noise(200'000, 32), buffer).size()),
              200'000 * 5 / 8.0, 1000);
}

// Values that are too rare for the sample, one byte in four thousand, still have a code.
TEST(NoiseDeflateTest, RareBytesComeBack) {
  Bytes bytes = noise(100'000, 3);
  for (std::size_t i = 0; i < 25; ++i) bytes[4000 * i + i] = static_cast<std::uint8_t>(200 + i);
  expect_unchanged(bytes);
}

// Runs are 258 bytes in some bits.
TEST(NoiseDeflateTest, OneValueTakesNextToNothing) {
  std::vector<char> buffer;
  EXPECT_LT(deflate_noise(Bytes(1'000'000, 3), buffer).size(), 3'000u);
}

}  // namespace
}  // namespace vinebench::harness
