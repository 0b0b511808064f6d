// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/statistics/power.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/util/random.h"
#include "harness/statistics/shares.h"

namespace vinebench::harness {
namespace {

constexpr int kSimulated = 10'000;
/// Four standard deviations of a power of 0.8 over the trials.
const double kSampling = 4 * std::sqrt(0.8 * 0.2 / kSimulated);

PairedMean simulated_mean(RandomSequence& random, std::size_t pairs, double effect) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < pairs; ++i) differences.push_back(random.normal(effect, 1));
  return paired_mean(differences);
}

PairedCounts simulated_counts(RandomSequence& random, std::size_t pairs, const PairRates& rates) {
  PairedCounts counts;
  for (std::size_t i = 0; i < pairs; ++i) {
    const double u = random.uniform();
    ++(u < rates.more ? counts.more : u < rates.more + rates.less ? counts.less : counts.same);
  }
  return counts;
}

// Cohen (1988), paired t test, two-sided 5 %, power 80 %: effects of 0.2, 0.5 and 0.8 standard
// deviations of the differences need 199, 34 and 15 pairs.
TEST(PowerTest, CohensSampleSizes) {
  EXPECT_EQ(pairs_to_detect(0.2, TestGoal{}).value(), 199U);
  EXPECT_EQ(pairs_to_detect(-0.5, TestGoal{}).value(), 34U);
  EXPECT_EQ(pairs_to_detect(0.8, TestGoal{}).value(), 15U);
  EXPECT_FALSE(pairs_to_detect(0, TestGoal{}));
  EXPECT_FALSE(pairs_to_detect(1e-3, TestGoal{}));  // millions
}

// A wrong claim is as likely as alpha where there is no difference.
TEST(PowerTest, WithoutAnEffectItIsAlpha) {
  EXPECT_NEAR(power_to_detect(12, 0, 0.03), 0.03, 1e-9);
  EXPECT_EQ(power_to_detect(1, 3, 0.05), 0);
  EXPECT_NEAR(power_to_show_equal(40, 1, 1, 0.05), 0.05, 1e-3);
}

TEST(PowerTest, PlannedTTestsReachTheirPower) {
  RandomSequence random(RandomStream(5, "power"));
  const std::size_t to_detect = pairs_to_detect(0.6, {.alpha = 0.01}).value();
  const std::size_t to_equal = pairs_to_show_equal(0.7, 0.1, TestGoal{}).value();
  int detected = 0;
  int equal = 0;
  for (int trial = 0; trial < kSimulated; ++trial) {
    detected += p_of_no_difference(simulated_mean(random, to_detect, 0.6)) <= 0.01;
    equal += p_of_no_equivalence(simulated_mean(random, to_equal, 0.1), 0.7) <= 0.05;
  }
  EXPECT_NEAR(detected / double(kSimulated), power_to_detect(to_detect, 0.6, 0.01), kSampling);
  EXPECT_NEAR(equal / double(kSimulated), power_to_show_equal(to_equal, 0.7, 0.1, 0.05), kSampling);
  EXPECT_LT(power_to_detect(to_detect - 1, 0.6, 0.01), 0.8);
  EXPECT_LT(power_to_show_equal(to_equal - 1, 0.7, 0.1, 0.05), 0.8);
}

TEST(PowerTest, EqualityNeedsAnEffectWithinTheMargin) {
  EXPECT_FALSE(pairs_to_show_equal(0.5, 0.5, TestGoal{}));
  EXPECT_FALSE(pairs_to_show_equal(PairRates{0.1, 0}, 0.1, TestGoal{}));
  EXPECT_FALSE(pairs_to_detect(PairRates{0.1, 0.1}, TestGoal{}));
}

// If nothing ever happens, 0.9^n must fall to 5 %: 29 pairs. If B always has more, 2 / 2^n must:
// 6 pairs.
TEST(PowerTest, CertainOutcomesNeedTheSmallestSamples) {
  EXPECT_EQ(pairs_to_show_equal(PairRates{0, 0}, 0.1, TestGoal{}).value(), 29U);
  EXPECT_EQ(pairs_to_detect(PairRates{1, 0}, TestGoal{}).value(), 6U);
}

// The bound of equality is Bonferroni's: the simulation may be above it.
TEST(PowerTest, PlannedExactTestsReachTheirPower) {
  RandomSequence random(RandomStream(6, "power"));
  const PairRates worse{0.25, 0.05};
  const PairRates rare{0.02, 0.02};
  const std::size_t to_detect = pairs_to_detect(worse, TestGoal{}).value();
  const std::size_t to_equal = pairs_to_show_equal(rare, 0.1, TestGoal{}).value();
  int detected = 0;
  int equal = 0;
  for (int trial = 0; trial < kSimulated; ++trial) {
    detected += p_of_no_difference(simulated_counts(random, to_detect, worse)) <= 0.05;
    equal += p_of_no_equivalence(simulated_counts(random, to_equal, rare), 0.1) <= 0.05;
  }
  EXPECT_NEAR(detected / double(kSimulated), power_to_detect(to_detect, worse, 0.05), kSampling);
  EXPECT_GE(equal / double(kSimulated), power_to_show_equal(to_equal, rare, 0.1, 0.05) - kSampling);
  EXPECT_GE(detected, kSimulated * (0.8 - kSampling));
}

}  // namespace
}  // namespace vinebench::harness
