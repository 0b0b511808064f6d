// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/comparison/seed_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/compared_runs.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using testing::AllOf;
using testing::HasSubstr;

CompareSettings detect(const std::vector<std::string>& changes,
                       const std::vector<std::string>& results = {}) {
  return {.margins = parse_margins(changes, "--detect"), .metrics = parse_metrics(results)};
}

std::vector<SeedRuns> seeds_with(const std::string& key, const std::vector<double>& values) {
  std::vector<SeedRuns> runs;
  for (const double value : values) {
    runs.push_back(test::seed_runs(static_cast<std::int64_t>(runs.size()), {{key, value}}));
  }
  return runs;
}

// Log ratios of -0.2 and 0.2 have the standard deviation 0.2 sqrt(2). Half of that is Cohen's
// medium effect, which needs 34 pairs.
TEST(SeedPlanTest, PairsTellTheSpreadOfADifference) {
  const auto pairs =
      test::run_pairs("/ate_rmse_m", {0.01, 0.03}, {0.01 * std::exp(-0.2), 0.03 * std::exp(0.2)});
  const double half = 100 * std::expm1(0.1 * std::sqrt(2.0));
  const auto plans = plan_seeds(pairs, detect({fmt::format("{}%", half)}));
  ASSERT_EQ(plans.size(), 1u);
  EXPECT_EQ(plans[0].seeds, 2u);
  EXPECT_NEAR(plans[0].spread, 0.2 * std::sqrt(2.0), 1e-12);
  EXPECT_EQ(plans[0].to_detect.value(), 34u);
  EXPECT_EQ(plans[0].to_show_equal, pairs_to_show_equal(0.5, 0, TestGoal{}));
}

// Within the scenarios the standard deviation of the differences is sqrt(2), whatever the
// scenarios' means: values 1, 3 and 101, 103 mm have sqrt(2) each, a difference of two sqrt(2)
// sqrt(2) = 2. To detect 1 mm is to detect half of that: 34.
TEST(SeedPlanTest, OneSystemGivesAnUpperBound) {
  std::vector<SeedRuns> runs = seeds_with("/ate_rmse_m", {0.001, 0.003, 0.101, 0.103});
  for (const std::size_t i : {2, 3}) runs[i].scenario = "loop";
  const auto plans = plan_seeds(runs, detect({"ate_rmse_m=1"}));
  EXPECT_EQ(plans.at(0).method, Method::kDifference);
  EXPECT_NEAR(plans[0].spread, 2, 1e-9);
  EXPECT_EQ(plans[0].to_detect.value(), 34u);
}

// One failure in four: of the 12 ordered pairs, 3 have the failure second.
TEST(SeedPlanTest, ChanceIsCountedForOrderedMetrics) {
  const auto plans = plan_seeds(seeds_with("/passed", {1, 0, 1, 1}), detect({"20%"}));
  EXPECT_EQ(plans.at(0).method, Method::kOrdered);
  EXPECT_NEAR(plans[0].rate, 0.25, 1e-12);
  EXPECT_EQ(plans[0].to_detect, pairs_to_detect(PairRates{0.45, 0.25}, TestGoal{}));
  EXPECT_FALSE(plans[0].to_show_equal);  // chance alone is above 20 %
}

// Two metrics of the estimate share alpha.
TEST(SeedPlanTest, MetricsShareAlpha) {
  std::vector<SeedRuns> runs = seeds_with("/ate_rmse_m", {0.01, 0.02, 0.03});
  for (SeedRuns& seed : runs)
    seed.repeats[0].values["/ate_origin_rmse_m"] = 0.1 + 0.01 * double(seed.seed);
  for (SeedRuns& seed : runs) seed.repeats[0].values["/cpu_seconds"] = 1 + double(seed.seed);
  const auto plans = plan_seeds(runs, detect({"10%"}));
  ASSERT_EQ(plans.size(), 3u);
  EXPECT_DOUBLE_EQ(plans[0].level, 0.025);
  EXPECT_DOUBLE_EQ(plans[2].level, 0.05);
  EXPECT_GT(plans[1].to_detect.value(),
            plan_seeds(runs, detect({"10%"}, {"ate_rmse_m"})).at(0).to_detect.value());
}

TEST(SeedPlanTest, ASingleSeedHasNoSpread) {
  EXPECT_THAT(test::error_of([] { plan_seeds(seeds_with("/ate_rmse_m", {1}), detect({"5%"})); }),
              HasSubstr("expected runs of at least two seeds of a scenario"));
  EXPECT_THAT(
      test::error_of([] { plan_seeds(test::run_pairs("/ate_rmse_m", {1}, {2}), detect({"5%"})); }),
      HasSubstr("expected runs of at least two seeds of a scenario"));
}

// A spread of zero needs the two pairs of a standard deviation.
TEST(SeedPlanTest, WithoutASpreadTwoPairsDo) {
  const auto plans = plan_seeds(seeds_with("/ate_rmse_m", {0.5, 0.5}), detect({"5%"}));
  EXPECT_EQ(plans.at(0).to_detect.value(), 2u);
}

TEST(SeedPlanTest, IsATableAndData) {
  const CompareSettings settings = detect({"5%"});
  const auto plans = plan_seeds(seeds_with("/passed", {1, 1, 1, 0}), settings);
  EXPECT_THAT(format_plan(plans, settings),
              AllOf(HasSubstr("| passed, % |              4 |    50 % of seeds |"),
                    HasSubstr("power of 80 %, at alpha = 0.05")));
  const Json json = plan_json(plans, settings);
  EXPECT_EQ(json["metrics"][0]["seeds_to_detect"], plans[0].to_detect.value());
  EXPECT_TRUE(json["metrics"][0]["seeds_to_show_equal"].is_null());
}

}  // namespace
}  // namespace vinebench::harness
