// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/comparison/seed_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/util/random.h"
#include "tests/support/compared_runs.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using testing::AllOf;
using testing::HasSubstr;

CompareSettings detect(const std::vector<std::string>& changes,
                       const std::vector<std::string>& metrics = {}) {
  return {.margins = parse_margins(changes, "--detect"), .metrics = parse_metrics(metrics)};
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

// B has more in two pairs of four: a quarter each way if that is chance.
TEST(SeedPlanTest, PairsThatDifferAreTakenAsChance) {
  const auto plans =
      plan_seeds(test::run_pairs("/losses", {0, 0, 0, 0}, {1, 0, 2, 0}), detect({"20%"}));
  EXPECT_NEAR(plans.at(0).rate, 0.25, 1e-12);
  EXPECT_EQ(plans[0].to_detect, pairs_to_detect(PairRates{0.45, 0.25}, TestGoal{}));
}

/// Pairs with errors that have 14 % of noise in their ratio, and losses with these probabilities.
std::vector<RunPair> simulated_pairs(RandomSequence& random, std::size_t seeds, double ratio,
                                     const PairRates& losses) {
  std::vector<RunPair> pairs;
  for (std::size_t i = 0; i < seeds; ++i) {
    const auto error = [&] { return std::exp(random.normal(-4, 0.1)); };
    const double draw = random.uniform();
    const auto seed = static_cast<std::int64_t>(i);
    const double more = draw < losses.more ? 1 : 0;
    const double less = draw >= losses.more && draw < losses.more + losses.less ? 1 : 0;
    pairs.push_back({test::seed_runs(seed, {{"/ate_rmse_m", error()}, {"/losses", less}}),
                     test::seed_runs(seed, {{"/ate_rmse_m", ratio * error()}, {"/losses", more}})});
  }
  return pairs;
}

/// A hundred pairs with just the spread and the chance of simulated_pairs().
std::vector<RunPair> measured_pairs() {
  std::vector<RunPair> pairs;
  for (int i = 0; i < 100; ++i) {
    const double ratio = std::exp((i % 2 == 0 ? 0.1 : -0.1) * std::sqrt(2.0));
    pairs.push_back({test::seed_runs(i, {{"/ate_rmse_m", 0.01}, {"/losses", i < 5 ? 1 : 0}}),
                     test::seed_runs(i, {{"/ate_rmse_m", ratio * 0.01},
                                         {"/losses", i >= 5 && i < 10 ? 1 : 0}})});
  }
  return pairs;
}

// 500 trials of 80 % have a standard deviation of 1.8 %; four are 7.2 %.
TEST(SeedPlanTest, PlannedSeedsReachTheirPower) {
  RandomSequence random(RandomStream(1, "planned seeds"));
  for (const char* metric : {"ate_rmse_m", "losses"}) {
    CompareSettings settings = detect({"20%"}, {metric});
    const MetricPlan planned = plan_seeds(measured_pairs(), settings).at(0);
    settings.goal.power = 1e-9;  // seeds that a verdict asks for are of no interest here
    const PairRates chance{0.05, 0.05};
    constexpr int kTrials = 500;
    int worse = 0;
    int equal = 0;
    for (int i = 0; i < kTrials; ++i) {
      const auto tested = [&](std::size_t seeds, double ratio, const PairRates& rates) {
        return compare_metrics(simulated_pairs(random, seeds, ratio, rates), settings).at(0);
      };
      worse += tested(planned.to_detect.value(), 1.2, {0.25, 0.05}).p_difference <= 0.05;
      equal += tested(planned.to_show_equal.value(), 1, chance).p_equivalence <= 0.05;
    }
    EXPECT_GE(worse, (0.8 - 0.072) * kTrials) << metric;
    EXPECT_GE(equal, (0.8 - 0.072) * kTrials) << metric;
  }
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
