// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/statistics/variance_components.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/util/random.h"

namespace vinebench::harness {
namespace {

// Strength of fabric of four looms (Montgomery, Design and Analysis of Experiments, the example of
// random effects): mean squares 29.73 and 1.90, F = 15.68, variances (29.73 - 1.90) / 4 = 6.96
// between looms and 1.90 within.
TEST(VarianceComponentsTest, MontgomerysLooms) {
  const auto looms =
      variance_components({{98, 97, 99, 96}, {91, 90, 93, 92}, {96, 95, 97, 95}, {95, 96, 99, 98}});
  ASSERT_TRUE(looms);
  EXPECT_EQ(looms->groups, 4U);
  EXPECT_EQ(looms->values, 16U);
  EXPECT_NEAR(looms->mean_square_between, 29.73, 5e-3);
  EXPECT_NEAR(looms->mean_square_within, 1.90, 5e-3);
  EXPECT_NEAR(looms->f.value(), 15.68, 5e-3);
  EXPECT_LT(looms->p.value(), 0.001);
  EXPECT_NEAR(looms->between, 6.96, 5e-3);
  EXPECT_NEAR(looms->within, 1.90, 5e-3);
  EXPECT_NEAR(looms->share_within(), 1.90 / 8.86, 1e-3);
}

// Sizes 1, 2, 3: (6 - 14 / 6) / 2 = 11 / 6. Means 1, 4, 2, overall 15 / 6: between (2.25 + 2 * 2.25
// + 3 * 0.25) / 2 = 3.75, within (2 + 2) / 3.
TEST(VarianceComponentsTest, GroupsMayHaveDifferentSizes) {
  const auto found = variance_components({{1}, {3, 5}, {1, 2, 3}});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->mean_square_between, 3.75, 1e-12);
  EXPECT_NEAR(found->within, 4.0 / 3, 1e-12);
  EXPECT_NEAR(found->between, (3.75 - 4.0 / 3) / (11.0 / 6), 1e-12);
}

TEST(VarianceComponentsTest, NeedsGroupsAndRepeats) {
  EXPECT_FALSE(variance_components({}));
  EXPECT_FALSE(variance_components({{1, 2, 3}}));
  EXPECT_FALSE(variance_components({{1}, {2}, {}}));
}

// A deterministic system: all variance is that of the worlds, which is the sample variance 1.
TEST(VarianceComponentsTest, RepeatsThatAgreeHaveNoVariance) {
  const auto found = variance_components({{1, 1}, {2, 2}, {3, 3}});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->within, 0);
  EXPECT_NEAR(found->between, 1, 1e-12);
  EXPECT_FALSE(found->f);
  EXPECT_EQ(found->share_within(), 0);
  EXPECT_EQ(variance_components({{1, 1}, {1, 1}})->share_within(), 0);
}

// 20,000 worlds of standard deviation 2, three repeats each of standard deviation 1. The standard
// errors are 1 * sqrt(2 / 40,000) = 0.007 and about (4 + 1 / 3) sqrt(2 / 20,000) = 0.043; four of
// them.
TEST(VarianceComponentsTest, FindsTheSimulatedVariances) {
  RandomSequence random(RandomStream(7, "variance components"));
  std::vector<std::vector<double>> groups;
  for (int world = 0; world < 20'000; ++world) {
    const double mean = random.normal(5, 2);
    groups.push_back({random.normal(mean, 1), random.normal(mean, 1), random.normal(mean, 1)});
  }
  const auto found = variance_components(groups);
  EXPECT_NEAR(found->within, 1, 0.028);
  EXPECT_NEAR(found->between, 4, 0.17);
}

// Where worlds do not differ, p is below 5 % in 5 % of 10,000 trials; four standard deviations.
TEST(VarianceComponentsTest, WorldsThatDoNotDifferAreRarelySaidTo) {
  RandomSequence random(RandomStream(8, "variance components"));
  int claimed = 0;
  for (int trial = 0; trial < 10'000; ++trial) {
    std::vector<std::vector<double>> groups(5);
    for (auto& group : groups) {
      for (int repeat = 0; repeat < 3; ++repeat) group.push_back(random.normal());
    }
    claimed += variance_components(groups)->p.value() <= 0.05;
  }
  EXPECT_NEAR(claimed / 10'000.0, 0.05, 0.0087);
}

}  // namespace
}  // namespace vinebench::harness
