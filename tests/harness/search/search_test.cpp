// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/search/search.h"

#include <gtest/gtest.h>

#include "tests/support/fake_search.h"

namespace vinebench::harness {
namespace {

using test::FakeSearch;

SearchSettings settings() {
  SearchSettings settings;
  settings.seeds = {1, 2, 3};
  return settings;
}

std::optional<CounterExample> search_with(FakeSearch& fake, std::size_t budget) {
  SearchRuns runs = fake.runs(budget);
  return search(runs, settings(), test::tell_nobody);
}

TEST(SearchTest, FindsShrinksAndProvesWithOtherSeeds) {
  FakeSearch fake(
      [](const ScenarioConfig& scenario, std::int64_t) {
        return test::speed_of(scenario) > 0.9 ? test::kBadError : test::kGoodError;
      },
      [](const ScenarioConfig&, std::int64_t) { return test::kGoodError; });
  const auto example = search_with(fake, 200);
  ASSERT_TRUE(example);
  EXPECT_TRUE(example->is_proven());
  ASSERT_EQ(example->proof.size(), 20u);
  EXPECT_EQ(example->proof.front().seed, 101);
  EXPECT_EQ(example->proof.front().other->verdict, RunVerdict::kPassed);
  EXPECT_EQ(example->condition.difficulties(), 1);
}

// Every other seed of the proof fails from 1.0 m/s on alone: severities grow, and the seeds that
// said so are not asked again.
TEST(SearchTest, GrowsWithNewSeedsWhereTheProofDoesNotAgree) {
  FakeSearch fake(
      [](const ScenarioConfig& scenario, std::int64_t seed) {
        const double least = seed > 100 && seed % 2 == 0 ? 1.0 : 0.9;
        return test::speed_of(scenario) > least ? test::kBadError : test::kGoodError;
      },
      [](const ScenarioConfig&, std::int64_t) { return test::kGoodError; });
  const auto example = search_with(fake, 200);
  ASSERT_TRUE(example);
  EXPECT_TRUE(example->is_proven());
  EXPECT_GT(example->condition.severities[0], 0.625);  // 1.0 m/s
  EXPECT_GT(example->proof.front().seed, 101);
}

// On the shortest route the reference fails with the seeds of the proof: the last step of shrinking
// is taken back.
TEST(SearchTest, TakesAStepBackWhereTheReferenceFailsToo) {
  FakeSearch fake(
      [](const ScenarioConfig& scenario, std::int64_t) {
        return test::speed_of(scenario) > 0.9 ? test::kBadError : test::kGoodError;
      },
      [](const ScenarioConfig& scenario, std::int64_t seed) {
        const bool shortest = scenario.simulation.duration.has_value();
        return seed > 100 && shortest ? test::kBadError : test::kGoodError;
      });
  const auto example = search_with(fake, 200);
  ASSERT_TRUE(example);
  EXPECT_TRUE(example->is_proven());
  EXPECT_FALSE(example->condition.cut.duration);
  EXPECT_EQ(example->proof.front().seed, 121);
}

// Low sun breaks it with the seeds that are searched with alone: by chance. A long gap does with
// all, and is found once the sun is dismissed.
TEST(SearchTest, WhatOtherSeedsDoNotBearOutIsDismissed) {
  FakeSearch fake(
      [](const ScenarioConfig& scenario, std::int64_t seed) {
        const bool chance = seed < 100 && test::sun_of(scenario) < 45;
        return chance || test::gap_of(scenario) > 4 ? test::kBadError : test::kGoodError;
      },
      [](const ScenarioConfig& scenario, std::int64_t seed) {
        const bool hard = seed > 100 && test::sun_of(scenario) < 49;
        return hard ? test::kBadError : test::kGoodError;
      });
  const auto example = search_with(fake, 200);
  ASSERT_TRUE(example);
  EXPECT_TRUE(example->is_proven());
  EXPECT_EQ(example->condition.severities[1], 0);
  EXPECT_GT(example->condition.severities[2], 0.7);  // until 3.9 s
  // Those of the sun were asked before: four times twenty at most.
  EXPECT_EQ(example->proof.front().seed, 101 + 4 * 20);
}

TEST(SearchTest, WithoutAReferenceTheSystemPassesWithoutTheDifficulties) {
  FakeSearch fake([](const ScenarioConfig& scenario, std::int64_t seed) {
    return test::speed_of(scenario) > 0.9 || seed % 5 == 0 ? test::kBadError : test::kGoodError;
  });
  const auto example = search_with(fake, 200);
  ASSERT_TRUE(example);
  // Seed 105 and others fail in any case: not every seed is one that the difficulty breaks.
  EXPECT_FALSE(example->is_proven());
  ASSERT_FALSE(example->disagreed.empty());
  EXPECT_EQ(example->disagreed.front().second.seed, 105);
}

TEST(SearchTest, NothingWhereNothingBreaksIt) {
  FakeSearch fake([](const ScenarioConfig&, std::int64_t) { return test::kGoodError; });
  EXPECT_FALSE(search_with(fake, 100));
  EXPECT_LE(fake.made, 100);
}

}  // namespace
}  // namespace vinebench::harness
