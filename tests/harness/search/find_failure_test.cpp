// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/search/find_failure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/fake_search.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using test::FakeSearch;

std::optional<Condition> find(FakeSearch& fake, std::size_t budget = 1000) {
  SearchRuns runs = fake.runs(budget);
  return find_failure(runs, 1, test::tell_nobody);
}

// From 0.5 to 1.3 m/s, 0.9 are half of the way.
TEST(FindFailureTest, OneDifficultyJustBeyondWhereItBegins) {
  FakeSearch fake([](const auto& scenario, auto) {
    return test::speed_of(scenario) > 0.9 ? test::kBadError : test::kGoodError;
  });
  const auto found = find(fake);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->difficulties(), 1);
  EXPECT_GT(found->severities[0], 0.5);
  EXPECT_LE(found->severities[0], 0.5 + 1.0 / 16);
  EXPECT_EQ(fake.made, 1 + 3 + 4);  // as it is, each alone, four halvings
}

TEST(FindFailureTest, TwoDifficultiesThatBreakItTogetherAlone) {
  FakeSearch fake([](const auto& scenario, auto) {
    return test::speed_of(scenario) > 0.9 && test::sun_of(scenario) < 27 ? test::kBadError
                                                                         : test::kGoodError;
  });
  const auto found = find(fake);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->difficulties(), 2);
  EXPECT_EQ(found->severities[2], 0);
  // Speed and sun each begin at a half; each is halved to a sixteenth.
  EXPECT_LE(found->severity(), 1 + 2.0 / 16 + 2 * kSeverityStep);
  EXPECT_LE(fake.made, 40);
}

// Both fail in a long gap; the system in a shorter one already.
TEST(FindFailureTest, WhereTheReferenceStandsLessThanTheWorst) {
  FakeSearch fake(
      [](const auto& scenario, auto) {
        return test::gap_of(scenario) > 3 ? test::kBadError : test::kGoodError;
      },
      [](const auto& scenario, auto) {
        return test::gap_of(scenario) > 4 ? test::kBadError : test::kGoodError;
      });
  const auto found = find(fake);
  ASSERT_TRUE(found);
  EXPECT_GT(found->severities[2], 0.25);  // 3 of 2.5 to 4.5 s
  EXPECT_LE(found->severities[2], 0.25 + 1.0 / 16);
}

// What breaks both alike is none of the system's.
TEST(FindFailureTest, NothingWhereTheReferenceFailsToo) {
  const auto both = [](const auto& scenario, auto) {
    return test::gap_of(scenario) > 3 ? test::kBadError : test::kGoodError;
  };
  FakeSearch fake(both, both);
  EXPECT_FALSE(find(fake));
}

// Where the reference fails at a milder point than the worst: 1.0 to 1.1 m/s do it no good.
TEST(FindFailureTest, APairWhoseReferenceIsNotMonotonous) {
  FakeSearch fake(
      [](const auto& scenario, auto) {
        return test::speed_of(scenario) > 1.0 && test::sun_of(scenario) < 27 ? test::kBadError
                                                                             : test::kGoodError;
      },
      [](const auto& scenario, auto) {
        const double speed = test::speed_of(scenario);
        return speed > 1.0 && speed < 1.1 ? test::kBadError : test::kGoodError;
      });
  const auto found = find(fake);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->difficulties(), 2);
  EXPECT_GE(found->severities[0], 0.75);  // 1.1 m/s
}

// The reference stands little more of both at once: the band between is an eighth wide.
TEST(FindFailureTest, APairOfWhichTheReferenceStandsLittleMore) {
  const auto beyond = [](const ScenarioConfig& scenario, double severity) {
    return test::speed_of(scenario) > 0.5 + 0.8 * severity &&
           test::gap_of(scenario) > 2.5 + 2.0 * severity;
  };
  FakeSearch fake(
      [&](const auto& s, auto) { return beyond(s, 0.25) ? test::kBadError : test::kGoodError; },
      [&](const auto& s, auto) { return beyond(s, 0.375) ? test::kBadError : test::kGoodError; });
  const auto found = find(fake);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->severities[1], 0);
  EXPECT_GT(found->severities[0], 0.25);
  EXPECT_LE(found->severities[0], 0.375);
  EXPECT_LE(found->severities[2], 0.375);
}

TEST(FindFailureTest, ThreeAtOnceByTheirGrowingError) {
  FakeSearch fake([](const auto& scenario, auto) {
    const double speed = (test::speed_of(scenario) - 0.5) / 0.8;
    const double sun = (50 - test::sun_of(scenario)) / 46;
    const double gap = (test::gap_of(scenario) - 2.5) / 2;
    return 0.005 + 0.08 * speed * sun * gap;  // beyond 0.03 where the product is 5/16
  });
  const auto found = find(fake);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->difficulties(), 3);
}

TEST(FindFailureTest, TheScenarioAsItIsMayBreakIt) {
  FakeSearch fake([](const auto&, auto) { return test::kBadError; });
  const auto found = find(fake);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->difficulties(), 0);
  EXPECT_EQ(fake.made, 1);
}

TEST(FindFailureTest, TheReferenceMustPassTheScenarioAsItIs) {
  FakeSearch fake([](const auto&, auto) { return test::kGoodError; },
                  [](const auto&, auto) { return test::kBadError; });
  EXPECT_THAT(test::error_of([&] { find(fake); }), testing::HasSubstr("the reference does not"));
}

// That is no verdict on the reference.
TEST(FindFailureTest, FindsNothingWhereTheBudgetDoesNotReachTheReference) {
  const auto good = [](const auto&, auto) { return test::kGoodError; };
  FakeSearch fake(good, good);
  EXPECT_FALSE(find(fake, 1));
}

TEST(FindFailureTest, EndsWithItsBudget) {
  FakeSearch fake([](const auto&, auto) { return test::kGoodError; });
  EXPECT_FALSE(find(fake, 5));
  EXPECT_EQ(fake.made, 5);
}

TEST(FindFailureTest, AtRandomUntilAsMild) {
  FakeSearch fake([](const auto& scenario, auto) {
    return test::speed_of(scenario) > 0.9 ? test::kBadError : test::kGoodError;
  });
  SearchRuns runs = fake.runs();
  const auto found = find_at_random(runs, 1, 7, 1, 0.6);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->difficulties(), 1);
  EXPECT_GT(found->severities[0], 0.5);
  EXPECT_LE(found->severity(), 0.6);
  // The same draws again.
  SearchRuns again = fake.runs();
  EXPECT_EQ(find_at_random(again, 1, 7, 1, 0.6), found);
  EXPECT_EQ(runs.count(), again.count());
}

TEST(FindFailureTest, TheFirstRunsAreThoseOfAnySearch) {
  FakeSearch fake([](const auto&, auto) { return test::kGoodError; });
  SearchRuns runs = fake.runs();
  runs.ask(first_queries(fake.problem, 1));
  EXPECT_EQ(fake.made, 4);
  (void)find_failure(runs, 1, test::tell_nobody);
  EXPECT_GT(fake.made, 4);
}

}  // namespace
}  // namespace vinebench::harness
