// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/statistics/paired_mean.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/util/random.h"

namespace vinebench::harness {
namespace {

/// Additional hours of sleep by two drugs, differences of ten patients (Student 1908, Biometrika
/// 6:1).
const std::vector<double> kSleep{1.2, 2.4, 1.3, 1.3, 0, 1.0, 1.8, 0.8, 4.6, 1.4};

/// Four standard deviations of a rate over so many simulated trials: exceeded by chance once in
/// 16,000 tests.
double tolerance(double rate, int trials) {
  return 4 * std::sqrt(rate * (1 - rate) / trials);
}

std::vector<double> normal_differences(RandomSequence& random, int pairs, double mean) {
  std::vector<double> differences;
  for (int i = 0; i < pairs; ++i) differences.push_back(random.normal(mean, 1));
  return differences;
}

// Mean 1.58, standard deviation 1.229995; t = 1.58 / (1.229995 / sqrt(10)) = 4.0621, of which
// textbooks give p = 0.002833 and the interval 0.70011 .. 2.45989.
TEST(PairedMeanTest, StudentsSleepData) {
  const PairedMean sample = paired_mean(kSleep);
  EXPECT_EQ(sample.pairs, 10U);
  EXPECT_NEAR(sample.mean, 1.58, 1e-12);
  EXPECT_NEAR(sample.spread, 1.229995, 1e-6);
  EXPECT_NEAR(p_of_no_difference(sample), 0.002833, 1e-6);
  const Interval interval = interval_of(sample, 0.05);
  EXPECT_NEAR(interval.low, 0.70011, 1e-5);
  EXPECT_NEAR(interval.high, 2.45989, 1e-5);
}

// The definition of two one-sided tests: equivalence at alpha = 0.05 where the 90 % interval lies
// within the margin.
TEST(PairedMeanTest, EquivalenceIsAnIntervalWithinTheMargin) {
  const PairedMean sample = paired_mean(kSleep);
  const double end = interval_of(sample, 0.10).high;
  EXPECT_NEAR(p_of_no_equivalence(sample, end), 0.05, 1e-9);
  EXPECT_LT(p_of_no_equivalence(sample, end + 0.01), 0.05);
  EXPECT_GT(p_of_no_equivalence(sample, end - 0.01), 0.05);
  PairedMean mirrored = sample;
  mirrored.mean = -sample.mean;
  EXPECT_NEAR(p_of_no_equivalence(mirrored, end), 0.05, 1e-9);
}

TEST(PairedMeanTest, WithoutASpreadNothingIsKnown) {
  const double huge = std::numeric_limits<double>::max();
  for (const auto& differences :
       {std::vector<double>{}, std::vector<double>{0.3}, std::vector<double>{huge, huge, -huge}}) {
    const PairedMean sample = paired_mean(differences);
    EXPECT_FALSE(sample.has_spread());
    EXPECT_EQ(p_of_no_difference(sample), 1);
    EXPECT_EQ(p_of_no_equivalence(sample, 10), 1);
  }
}

// Pairs that all differ by the same: their mean is known.
TEST(PairedMeanTest, PairsThatAgreeAreExact) {
  const PairedMean same = paired_mean({0, 0, 0});
  EXPECT_EQ(p_of_no_difference(same), 1);
  EXPECT_EQ(p_of_no_equivalence(same, 0.1), 0);
  const PairedMean shifted = paired_mean({0.3, 0.3, 0.3});
  EXPECT_EQ(shifted.spread, 0);  // not the rounding of their sum
  EXPECT_EQ(p_of_no_difference(shifted), 0);
  EXPECT_EQ(p_of_no_equivalence(shifted, 0.1), 1);
}

// 95 % intervals of 5 normal differences contain the mean in 95 % of 20,000 trials.
TEST(PairedMeanTest, IntervalsContainTheMeanAsOftenAsTheySay) {
  RandomSequence random(RandomStream(1, "paired mean"));
  constexpr int kTrials = 20'000;
  int contained = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Interval interval = interval_of(paired_mean(normal_differences(random, 5, 0.4)), 0.05);
    contained += interval.low <= 0.4 && 0.4 <= interval.high ? 1 : 0;
  }
  EXPECT_NEAR(contained / double(kTrials), 0.95, tolerance(0.95, kTrials));
}

// Under the hypotheses, p-values of at most 5 % come in 5 % of the trials: no difference for the
// one; a mean at the margin, far beyond the spread of the mean, for the other.
TEST(PairedMeanTest, FalseClaimsAreAsRareAsTheySay) {
  RandomSequence random(RandomStream(2, "paired mean"));
  constexpr int kTrials = 20'000;
  int different = 0;
  int equal = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    different += p_of_no_difference(paired_mean(normal_differences(random, 8, 0))) <= 0.05;
    equal += p_of_no_equivalence(paired_mean(normal_differences(random, 8, 3)), 3) <= 0.05;
  }
  EXPECT_NEAR(different / double(kTrials), 0.05, tolerance(0.05, kTrials));
  EXPECT_NEAR(equal / double(kTrials), 0.05, tolerance(0.05, kTrials));
}

}  // namespace
}  // namespace vinebench::harness
