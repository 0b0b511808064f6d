// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/statistics/shares.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/util/random.h"

namespace vinebench::harness {
namespace {

// No failure in 20 runs: the upper end solves (1 - x)^20 = 0.025. 3 of 20: tables have 3.21 % and
// 37.89 %.
TEST(SharesTest, ClopperAndPearsonsInterval) {
  const Interval none = clopper_pearson(0, 20, 0.05);
  EXPECT_EQ(none.low, 0);
  EXPECT_NEAR(none.high, 1 - std::pow(0.025, 1.0 / 20), 1e-12);
  const Interval some = clopper_pearson(3, 20, 0.05);
  EXPECT_NEAR(some.low, 0.0321, 5e-5);
  EXPECT_NEAR(some.high, 0.3789, 5e-5);
  const Interval all = clopper_pearson(20, 20, 0.05);
  EXPECT_NEAR(all.low, std::pow(0.025, 1.0 / 20), 1e-12);
  EXPECT_EQ(all.high, 1);
}

// Exact coverage at one rate, by summing over all outcomes: never less than 95 %.
TEST(SharesTest, ClopperAndPearsonsIntervalContainsTheRate) {
  for (const double rate : {0.02, 0.1, 0.3, 0.5}) {
    double coverage = 0;
    for (std::size_t k = 0; k <= 20; ++k) {
      const Interval interval = clopper_pearson(k, 20, 0.05);
      if (rate < interval.low || rate > interval.high) continue;
      coverage += std::exp(std::lgamma(21) - std::lgamma(k + 1.0) - std::lgamma(21.0 - k)) *
                  std::pow(rate, k) * std::pow(1 - rate, 20.0 - k);
    }
    EXPECT_GE(coverage, 0.95) << rate;
  }
}

// 10 against 2: 2 (1 + 12 + 66) / 2^12. As many of both: 1. Same pairs do not take part.
TEST(SharesTest, McNemarsExactTest) {
  EXPECT_NEAR(p_of_no_difference({.more = 10, .less = 2, .same = 7}), 158.0 / 4096, 1e-15);
  EXPECT_NEAR(p_of_no_difference({.more = 2, .less = 10, .same = 0}), 158.0 / 4096, 1e-15);
  EXPECT_NEAR(p_of_no_difference({.more = 5, .less = 0, .same = 9}), 2.0 / 32, 1e-15);
  EXPECT_EQ(p_of_no_difference({.more = 3, .less = 3, .same = 1}), 1);
  EXPECT_EQ(p_of_no_difference({.more = 0, .less = 0, .same = 9}), 1);
}

// Nothing in n pairs has the probability 0.9^n where it happens in a tenth: 28 pairs leave more
// than 5 %, 29 less (the "rule of three": 3 / 29 = 10 %).
TEST(SharesTest, EquivalenceNeedsEnoughPairs) {
  EXPECT_NEAR(p_of_no_equivalence({.more = 0, .less = 0, .same = 28}, 0.1), std::pow(0.9, 28),
              1e-12);
  EXPECT_GT(p_of_no_equivalence({.more = 0, .less = 0, .same = 28}, 0.1), 0.05);
  EXPECT_LT(p_of_no_equivalence({.more = 0, .less = 0, .same = 29}, 0.1), 0.05);
  EXPECT_NEAR(p_of_no_equivalence({.more = 1, .less = 0, .same = 28}, 0.1),
              std::pow(0.9, 29) + 29 * 0.1 * std::pow(0.9, 28), 1e-12);
  EXPECT_EQ(p_of_no_equivalence(PairedCounts{}, 0.1), 1);
}

// 0 of 20 for both: each at 97.5 %, so 1 - 0.0125^(1/20) at either side.
TEST(SharesTest, TheNetShareHasAnInterval) {
  const double end = 1 - std::pow(0.0125, 1.0 / 20);
  const Interval interval = interval_of(PairedCounts{.more = 0, .less = 0, .same = 20}, 0.05);
  EXPECT_NEAR(interval.low, -end, 1e-12);
  EXPECT_NEAR(interval.high, end, 1e-12);
  const PairedCounts counts{.more = 5, .less = 1, .same = 14};
  EXPECT_NEAR(counts.net_share(), 0.2, 1e-15);
  EXPECT_LT(interval_of(counts, 0.05).low, 0.2);
  EXPECT_GT(interval_of(counts, 0.05).high, 0.2);
}

PairedCounts draw(RandomSequence& random, int pairs, double more, double less) {
  PairedCounts counts;
  for (int i = 0; i < pairs; ++i) {
    const double u = random.uniform();
    ++(u < more ? counts.more : u < more + less ? counts.less : counts.same);
  }
  return counts;
}

// Exact tests err at most as often as they say, mostly less. Four standard deviations of 5 % over
// 10,000 trials: 0.9 %.
TEST(SharesTest, FalseClaimsAreRare) {
  RandomSequence random(RandomStream(3, "shares"));
  constexpr int kTrials = 10'000;
  int different = 0;
  int equal = 0;
  int outside = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    different += p_of_no_difference(draw(random, 30, 0.2, 0.2)) <= 0.05;
    equal += p_of_no_equivalence(draw(random, 60, 0.1, 0), 0.1) <= 0.05;
    const Interval interval = interval_of(draw(random, 30, 0.2, 0.05), 0.05);
    outside += interval.low > 0.15 || interval.high < 0.15;
  }
  EXPECT_LE(different, kTrials * 0.059);
  EXPECT_GT(different, kTrials * 0.005);  // but it does reject
  EXPECT_LE(equal, kTrials * 0.059);
  EXPECT_GT(equal, kTrials * 0.005);
  EXPECT_LE(outside, kTrials * 0.059);
}

}  // namespace
}  // namespace vinebench::harness
