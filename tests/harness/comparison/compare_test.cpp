// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/comparison/compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/util/random.h"
#include "tests/support/compared_runs.h"

namespace vinebench::harness {
namespace {

using test::run_pairs;
using testing::DoubleNear;
using testing::ElementsAre;

/// The one metric of these pairs.
MetricComparison comparison_of(const std::vector<RunPair>& pairs,
                               const std::vector<std::string>& margins = {}) {
  const CompareSettings settings{.margins = parse_margins(margins, "--margin")};
  return compare_metrics(pairs, settings).at(0);
}

/// The ATE from some values to others, m.
MetricComparison ate_of(const std::vector<double>& before, const std::vector<double>& after,
                        const std::vector<std::string>& margins = {}) {
  return comparison_of(run_pairs("/ate_rmse_m", before, after), margins);
}

// Twice, four times and twice: logarithms ln 2, 2 ln 2, ln 2 with the mean 4/3 ln 2 and the
// standard deviation ln 2 / sqrt(3). t of two degrees is 4.30265: +- 4.30265 / 3 ln 2.
TEST(CompareTest, ErrorsAreComparedByTheirRatios) {
  const MetricComparison result = ate_of({0.01, 0.02, 0.05}, {0.02, 0.08, 0.10});
  EXPECT_EQ(result.metric.title, "ATE, mm");
  EXPECT_EQ(result.method, Method::kRatio);
  EXPECT_EQ(result.pairs(), 3U);
  const double ln2 = std::log(2.0);
  EXPECT_THAT(result.differences, ElementsAre(DoubleNear(ln2, 1e-12), DoubleNear(2 * ln2, 1e-12),
                                              DoubleNear(ln2, 1e-12)));
  EXPECT_NEAR(result.mean_before, std::cbrt(10 * 20 * 50.0), 1e-9);  // geometric, mm
  EXPECT_NEAR(result.effect, 4 * ln2 / 3, 1e-12);
  EXPECT_NEAR(result.interval.value().low, (4 - 4.30265) * ln2 / 3, 1e-5);
  EXPECT_NEAR(result.interval.value().high, (4 + 4.30265) * ln2 / 3, 1e-5);
  EXPECT_NEAR(result.margin, std::log(1.1), 1e-12);
  EXPECT_EQ(result.verdict, Verdict::kCannotTell);
}

// All of them twice as large but for 1 %.
TEST(CompareTest, PairsTakeOutWhatSeedsHaveInCommon) {
  const std::vector<double> few{0.010, 0.050, 0.200};
  const std::vector<double> many{0.020, 0.101, 0.398};
  EXPECT_EQ(ate_of(few, many).verdict, Verdict::kWorse);
  EXPECT_EQ(ate_of(many, few).verdict, Verdict::kBetter);
}

// 1 to 2 % worse: within 10 %, and certainly so. Within 1 % it is not.
TEST(CompareTest, ADifferenceWithinTheMarginIsEqual) {
  const std::vector<double> before{0.010, 0.020, 0.030, 0.040, 0.050};
  const std::vector<double> after{0.0101, 0.0203, 0.0306, 0.0404, 0.0510};
  EXPECT_LT(ate_of(before, after).p_difference, 0.05);
  EXPECT_EQ(ate_of(before, after).verdict, Verdict::kEqual);
  EXPECT_EQ(ate_of(before, after, {"1%"}).verdict, Verdict::kWorse);
  EXPECT_EQ(ate_of(before, after, {"1%", "ate_rmse_m=10%"}).verdict, Verdict::kEqual);
}

// Differences 1, 2, 3 mm: mean 2, standard deviation 1, half width 4.30265 / sqrt(3).
TEST(CompareTest, AMarginInTheMetricsUnitAsksForDifferences) {
  const MetricComparison result =
      ate_of({0.010, 0.011, 0.012}, {0.011, 0.013, 0.015}, {"ate_rmse_m=8"});
  EXPECT_EQ(result.method, Method::kDifference);
  EXPECT_NEAR(result.effect, 2, 1e-9);
  EXPECT_NEAR(result.interval.value().high, 2 + 4.30265 / std::sqrt(3.0), 1e-4);
  EXPECT_EQ(result.margin, 8);
  EXPECT_EQ(result.verdict, Verdict::kEqual);  // t of 0.95 is 2.92: the 90 % end is 3.7 mm
}

TEST(CompareTest, OnePairTellsNothing) {
  const MetricComparison result = ate_of({0.01}, {0.02});
  EXPECT_FALSE(result.interval);
  EXPECT_FALSE(result.needed);
  EXPECT_EQ(result.verdict, Verdict::kCannotTell);
  EXPECT_EQ(ate_of({0.01}, {0.01}).verdict, Verdict::kCannotTell);
}

// An error of zero has no ratio: B has less in one pair of two.
TEST(CompareTest, ValuesThatAreNotPositiveAreOrdered) {
  const MetricComparison result = ate_of({0.01, 0.02}, {0.0, 0.02});
  EXPECT_EQ(result.method, Method::kOrdered);
  EXPECT_EQ(result.counts.less, 1U);
  EXPECT_EQ(result.counts.same, 1U);
}

// Fewer losses in 8 of 8 pairs: 2 / 2^8 = 0.8 %. In 5 of 5 pairs: 6 %.
TEST(CompareTest, CountsAreComparedBySigns) {
  const auto losses = [](std::size_t pairs) {
    return comparison_of(
        run_pairs("/losses", std::vector<double>(pairs, 3), std::vector<double>(pairs, 1)));
  };
  EXPECT_NEAR(losses(8).p_difference, 2.0 / 256, 1e-12);
  EXPECT_EQ(losses(8).verdict, Verdict::kBetter);
  EXPECT_EQ(losses(5).verdict, Verdict::kCannotTell);
  EXPECT_EQ(losses(8).effect, -1);
}

// Without any loss, 29 pairs show that less than a tenth have more or less: 0.9^29 = 4.7 %.
TEST(CompareTest, RareEventsNeedManySeedsToBeEqual) {
  const auto none = [](std::size_t pairs) {
    return comparison_of(
        run_pairs("/losses", std::vector<double>(pairs, 0), std::vector<double>(pairs, 0)));
  };
  EXPECT_EQ(none(29).verdict, Verdict::kEqual);
  EXPECT_EQ(none(28).verdict, Verdict::kCannotTell);
  EXPECT_EQ(none(28).needed.value(), 29U);
}

// Fewer losses in all of 5 pairs, as one of four metrics: 2 / 2^n must fall to 1.25 %, with 8
// pairs. One of 5 less may be chance: the net share of 20 % less its error, sqrt((0.2 - 0.04) / 5)
// = 18 %, is below the margin.
TEST(CompareTest, SeedsAreAskedForByTheEffectLessItsError) {
  const auto needed = [](const std::vector<double>& after) {
    std::vector<RunPair> pairs = run_pairs("/losses", std::vector<double>(5, 3), after);
    for (RunPair& pair : pairs) {
      for (const char* key : {"/coverage", "/loop_closures/wrong", "/loop_closures/missed"}) {
        pair.before.repeats[0].values[key] = pair.after.repeats[0].values[key] = 0;
      }
    }
    const auto results = compare_metrics(pairs, {});
    EXPECT_EQ(results[1].metric.title, "losses");
    EXPECT_DOUBLE_EQ(results[1].level, 0.05 / 4);
    return results[1].needed;
  };
  EXPECT_EQ(needed({1, 1, 1, 1, 1}), 8U);
  const TestGoal goal{.alpha = 0.05 / 4};
  EXPECT_EQ(needed({1, 3, 3, 3, 3}), pairs_to_detect(PairRates{0.2, 0.1}, goal));
}

// 5 % measured, with a standard error of 0.04 / sqrt(3) = 2.3 %: below 10 %.
TEST(CompareTest, SmallEffectsAreToBeShownEqual) {
  CompareSettings settings;
  settings.metrics = parse_metrics({"ate_rmse_m"});
  settings.goal.alpha = 0.001;  // three pairs do not tell
  const auto pairs =
      run_pairs("/ate_rmse_m", {0.01, 0.01, 0.01},
                {0.01 * std::exp(0.01), 0.01 * std::exp(0.05), 0.01 * std::exp(0.09)});
  const MetricComparison result = compare_metrics(pairs, settings).at(0);
  EXPECT_NEAR(result.sample.spread, 0.04, 1e-12);
  EXPECT_EQ(result.needed,
            pairs_to_show_equal(std::log(1.1) / 0.04, (0.05 + 0.04 / std::sqrt(3.0)) / 0.04,
                                settings.goal));
}

// The ratios 1, 2, 4, 2: mean ln 2, standard deviation ln 2 sqrt(2 / 3), standard error half of it;
// the rest is (1 - 0.408) ln 2, 0.725 standard deviations.
TEST(CompareTest, LargeEffectsAreToBeDetected) {
  const MetricComparison result = ate_of({0.01, 0.01, 0.01, 0.01}, {0.01, 0.02, 0.04, 0.02});
  EXPECT_EQ(result.verdict, Verdict::kCannotTell);
  const double root = std::sqrt(2.0 / 3);
  EXPECT_EQ(result.needed, pairs_to_detect((1 - root / 2) / root, TestGoal{}));
}

// A coverage within half a percent is the same; a named tolerance takes its place.
TEST(CompareTest, OrderedValuesHaveATolerance) {
  const auto pairs = run_pairs("/coverage", {0.99, 0.90}, {0.994, 0.95});
  EXPECT_EQ(comparison_of(pairs).counts.same, 1U);
  EXPECT_EQ(comparison_of(pairs).counts.more, 1U);
  EXPECT_EQ(comparison_of(pairs, {"coverage=6"}).counts.same, 2U);
}

// All runs have the same bytes; two seeds suffice, in every metric of the estimate.
TEST(CompareTest, IdenticalRunsAreEqual) {
  std::vector<RunPair> pairs;
  for (const std::int64_t seed : {1, 2}) {
    SeedRuns runs = test::seed_runs(seed, {{"/losses", 0}, {"/ate_rmse_m", 0.01}});
    runs.repeats[0].json = test::hash_json("abc");
    pairs.push_back({runs, runs});
  }
  for (const MetricComparison& result : compare_metrics(pairs, {})) {
    EXPECT_EQ(result.verdict, Verdict::kEqual) << result.metric.title;
    EXPECT_EQ(result.interval.value().high, 0) << result.metric.title;
  }
  for (const Json& other : {test::hash_json("abd"), test::hash_json("abc", "glibc")}) {
    pairs[1].after.repeats[0].json = other;
    EXPECT_EQ(compare_metrics(pairs, {}).back().verdict, Verdict::kCannotTell) << other;  // losses
  }
}

TEST(CompareTest, TheOverallVerdictIsThatOfTheEstimate) {
  const auto verdict = [](Verdict ate, Verdict coverage, Verdict speed) {
    const Metric cost{.of_estimate = false};
    return overall({{.verdict = ate}, {.verdict = coverage}, {.metric = cost, .verdict = speed}});
  };
  using enum Verdict;
  EXPECT_EQ(verdict(kEqual, kEqual, kWorse), kEqual);
  EXPECT_EQ(verdict(kBetter, kEqual, kWorse), kBetter);
  EXPECT_EQ(verdict(kCannotTell, kWorse, kBetter), kWorse);
  EXPECT_EQ(verdict(kBetter, kWorse, kEqual), kMixed);
  EXPECT_EQ(verdict(kCannotTell, kEqual, kEqual), kCannotTell);
  EXPECT_EQ(overall({}), kCannotTell);
}

/// How a simulated B differs from A.
struct Change {
  double log_ratio = 0;  ///< of its errors
  double loss = 0.1;     ///< probability of a loss in B; 0.1 in A
};

/// Worlds multiply both systems' errors (three metrics, which have the world in common); each
/// system adds 10 % of its own.
std::vector<RunPair> simulate(RandomSequence& random, std::size_t seeds, const Change& change) {
  std::vector<RunPair> pairs;
  for (std::size_t seed = 0; seed < seeds; ++seed) {
    const double world = random.normal(-4, 0.5);
    const auto run = [&](double ratio, double loss) {
      const auto error = [&] { return std::exp(world + ratio + random.normal(0, 0.1)); };
      return test::seed_runs(static_cast<std::int64_t>(seed),
                             {{"/ate_rmse_m", error()},
                              {"/ate_origin_rmse_m", error()},
                              {"/rpe_trans_percent", error()},
                              {"/losses", random.uniform() < loss ? 1 : 0}});
    };
    SeedRuns before = run(0, 0.1);
    pairs.push_back({std::move(before), run(change.log_ratio, change.loss)});
  }
  return pairs;
}

/// Share of simulated comparisons in which any metric of the key's method has the verdict.
struct VerdictRates {
  double different = 0;  ///< better or worse, any metric
  double equal = 0;      ///< any metric
  double right = 0;      ///< all errors are worse
};

VerdictRates verdict_rates(const char* stream, std::size_t seeds, const Change& change,
                           int comparisons) {
  RandomSequence random(RandomStream(1, stream));
  CompareSettings settings;
  settings.goal.power = 1e-9;  // seeds that a verdict asks for are of no interest here
  VerdictRates rates;
  for (int i = 0; i < comparisons; ++i) {
    bool different = false;
    bool equal = false;
    int worse = 0;
    for (const MetricComparison& result :
         compare_metrics(simulate(random, seeds, change), settings)) {
      different |= result.verdict == Verdict::kBetter || result.verdict == Verdict::kWorse;
      equal |= result.verdict == Verdict::kEqual;
      worse += result.verdict == Verdict::kWorse && result.method == Method::kRatio;
    }
    rates.different += different / double(comparisons);
    rates.equal += equal / double(comparisons);
    rates.right += (worse == 3) / double(comparisons);
  }
  return rates;
}

// Without any difference, a false "better" or "worse" in any of four metrics has a probability of
// 5 % at most. Four standard deviations over 1,000 comparisons: 2.8 %.
TEST(CompareSimulationTest, FalseDifferencesAreRare) {
  for (const std::size_t seeds : {3, 5, 10}) {
    EXPECT_LE(verdict_rates("no difference", seeds, Change{}, 1000).different, 0.05 + 0.028)
        << seeds;
  }
}

// With errors off by the margin exactly and losses more frequent by it, so is a false "equal".
TEST(CompareSimulationTest, FalseEqualitiesAreRare) {
  const Change at_margin{.log_ratio = std::log(1.1), .loss = 0.2};
  EXPECT_LE(verdict_rates("at the margin", 40, at_margin, 1000).equal, 0.05 + 0.028);
}

// Errors 30 % worse, with 14 % of noise in a pair's ratio: 2 standard deviations, and 12 seeds.
TEST(CompareSimulationTest, LargeDifferencesAreFound) {
  EXPECT_GE(verdict_rates("worse", 12, Change{.log_ratio = std::log(1.3)}, 500).right, 0.95);
}

// The number of seeds that a first comparison asks for, tried out on others. Half the margin is
// measured, so that it is to be enough for either truth. The spread is known by 40 seeds to 11 %,
// its square to 23 %, which moves a power of 80 % by 10 %.
TEST(CompareSimulationTest, TheSeedsAskedForTell) {
  RandomSequence random(RandomStream(1, "seeds asked for"));
  CompareSettings settings;
  settings.margins = parse_margins({"3%"}, "--margin");
  settings.metrics = parse_metrics({"ate_rmse_m"});
  const auto verdict = [&](std::size_t seeds, double ratio) {
    const Change change{.log_ratio = std::log(ratio)};
    return compare_metrics(simulate(random, seeds, change), settings).at(0);
  };
  const MetricComparison first = verdict(40, 1.015);
  ASSERT_EQ(first.needed, std::max(pairs_to_detect(first.margin / first.sample.spread, {}),
                                   pairs_to_show_equal(first.margin / first.sample.spread, 0, {})));
  int equal = 0;
  int worse = 0;
  constexpr int kTrials = 200;
  for (int trial = 0; trial < kTrials; ++trial) {
    equal += verdict(*first.needed, 1).verdict == Verdict::kEqual;
    worse += verdict(*first.needed, 1.03).verdict == Verdict::kWorse;
  }
  EXPECT_GE(equal, kTrials * 0.7);
  EXPECT_GE(worse, kTrials * 0.7);
}

}  // namespace
}  // namespace vinebench::harness
