// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/util/random.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <set>

namespace vinebench {
namespace {

constexpr std::uint64_t kDraws = 200000;

/// Share of equal bits over many draws; 1/2 for independent streams.
double agreement(const RandomStream& a, const RandomStream& b) {
  constexpr std::uint64_t kWords = 2000;
  int different = 0;
  for (std::uint64_t i = 0; i < kWords; ++i) different += std::popcount(a.bits(i) ^ b.bits(i));
  return 1 - different / (64.0 * kWords);
}

TEST(RandomTest, ADrawDependsOnItsIndexAlone) {
  const RandomStream stream(7, "noise", 3);
  const double fifth = stream.normal(5);
  for (std::uint64_t i = 100; i > 0; --i) stream.bits(i);
  EXPECT_EQ(stream.normal(5), fifth);
  EXPECT_EQ(RandomStream(7, "noise", 3).normal(5), fifth);
}

TEST(RandomTest, SeedNameFrameAndIndexEachMakeAnotherStream) {
  const RandomStream stream(7, "noise", 3);
  // 128,000 fair bits: one standard deviation of their mean is 0.0014.
  EXPECT_NEAR(agreement(stream, RandomStream(8, "noise", 3)), 0.5, 0.006);
  EXPECT_NEAR(agreement(stream, RandomStream(7, "noisf", 3)), 0.5, 0.006);
  EXPECT_NEAR(agreement(stream, RandomStream(7, "noise", 4)), 0.5, 0.006);
  EXPECT_NEAR(agreement(stream, RandomStream(3, "noise", 7)), 0.5, 0.006);
  EXPECT_EQ(agreement(stream, RandomStream(7, "noise", 3)), 1);
  std::set<std::uint64_t> seen;
  for (std::uint64_t i = 0; i < 10000; ++i) seen.insert(stream.bits(i));
  EXPECT_EQ(seen.size(), 10000u);
}

TEST(RandomTest, UniformFillsItsIntervalEvenly) {
  const RandomStream stream(1, "uniform");
  double sum = 0;
  double squares = 0;
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    const double u = stream.uniform(i);
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    sum += u;
    squares += u * u;
  }
  const double mean = sum / kDraws;
  // Four standard errors: 0.2887 / sqrt(n) = 0.00065 of the mean, 0.0745 / sqrt(n) of the variance.
  EXPECT_NEAR(mean, 0.5, 0.0026);
  EXPECT_NEAR(squares / kDraws - mean * mean, 1.0 / 12, 0.0007);
  EXPECT_EQ(stream.uniform(9, -3, 5), -3 + 8 * stream.uniform(9));
}

TEST(RandomTest, NormalHasTheMomentsOfTheBell) {
  const RandomStream stream(1, "normal");
  double moments[5] = {};
  int beyond_two = 0;
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    const double z = stream.normal(i);
    ASSERT_TRUE(std::isfinite(z));
    for (int m = 1; m <= 4; ++m) moments[m] += std::pow(z, m) / kDraws;
    beyond_two += std::abs(z) > 2;
  }
  // Standard errors with n draws: 1, sqrt(2), sqrt(15), sqrt(96) / sqrt(n); four of each.
  const double error = 4 / std::sqrt(static_cast<double>(kDraws));
  EXPECT_NEAR(moments[1], 0, error);
  EXPECT_NEAR(moments[2], 1, 1.42 * error);
  EXPECT_NEAR(moments[3], 0, 3.9 * error);
  EXPECT_NEAR(moments[4], 3, 9.8 * error);
  EXPECT_NEAR(static_cast<double>(beyond_two) / kDraws, 0.0455, 0.21 * error);
}

TEST(RandomTest, ASequenceReadsItsStreamInOrder) {
  const RandomStream stream(4, "sequence");
  RandomSequence sequence(stream);
  EXPECT_EQ(sequence.uniform(), stream.uniform(0));
  EXPECT_EQ(sequence.normal(10, 2), 10 + 2 * stream.normal(1));
  EXPECT_EQ(sequence.uniform(5, 6), 5 + stream.uniform(2));
  std::set<int> seen;
  for (int i = 0; i < 200; ++i) seen.insert(sequence.below(6));
  EXPECT_EQ(seen, (std::set<int>{0, 1, 2, 3, 4, 5}));
}

TEST(RandomTest, HashIsFnv1a) {
  // Published test vectors of the 64-bit FNV-1a.
  EXPECT_EQ(fnv1a(""), 0xcbf29ce484222325ULL);
  EXPECT_EQ(fnv1a("a"), 0xaf63dc4c8601ec8cULL);
  EXPECT_EQ(fnv1a("foobar"), 0x85944171f73967e8ULL);
  EXPECT_EQ(fnv1a("bar", fnv1a("foo")), fnv1a("foobar"));
}

}  // namespace
}  // namespace vinebench
