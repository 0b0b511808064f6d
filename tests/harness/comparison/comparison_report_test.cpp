// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/comparison/comparison_report.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/compared_runs.h"

namespace vinebench::harness {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

PairedRuns passed_runs() {
  PairedRuns runs;
  for (std::int64_t seed = 0; seed < 20; ++seed) {
    const double passed = seed < 3 ? 0 : 1;
    runs.pairs.push_back({test::seed_runs(seed, {{"/passed", passed}, {"/ate_rmse_m", 0.01}}),
                          test::seed_runs(seed, {{"/passed", 1}, {"/ate_rmse_m", 0.01}})});
  }
  return runs;
}

// Geometric means: the cube roots of 10 * 50 * 200 and of 20 * 101 * 398.
TEST(ComparisonReportTest, SaysWhatItIsSureOf) {
  PairedRuns runs;
  runs.pairs = test::run_pairs("/ate_rmse_m", {0.010, 0.050, 0.200}, {0.020, 0.101, 0.398});
  runs.unpaired = {"row, seed 9 (only in a)"};
  runs.differing = {"row, seed 1: world.sun"};
  EXPECT_THAT(
      format_comparison(runs, {}),
      AllOf(HasSubstr("row: B is worse (by the estimate's metrics, 3 pairs)"),
            HasSubstr("| ATE, mm |     3 | 46.42 | 92.98 | +100.3 % |"),
            HasSubstr("|   10 % |   worse |"), HasSubstr("not compared: row, seed 9 (only in a)\n"),
            HasSubstr("warning: not the same experiment: row, seed 1: world.sun\n"),
            Not(HasSubstr("failing:"))));
}

TEST(ComparisonReportTest, AsksForSeeds) {
  PairedRuns runs;
  runs.pairs = test::run_pairs("/losses", std::vector<double>(27, 0), std::vector<double>(27, 0));
  EXPECT_THAT(format_comparison(runs, {}),
              AllOf(HasSubstr("row: cannot tell yet how B differs from A"),
                    HasSubstr("| cannot tell yet: 2 more seeds |"), HasSubstr("10 % of seeds")));
  runs.pairs = test::run_pairs("/ate_rmse_m", {0.01}, {0.02});
  EXPECT_THAT(format_comparison(runs, {}), HasSubstr("cannot tell yet: at least 1 more seed "));
}

// Some hundreds: rounded up to tens.
TEST(ComparisonReportTest, ManySeedsAreRounded) {
  PairedRuns runs;
  runs.pairs = test::run_pairs("/ate_rmse_m", {0.01, 0.01, 0.01}, {0.012, 0.007, 0.014});
  const std::size_t more = compare_metrics(runs.pairs, {}).at(0).needed.value() - 3;
  ASSERT_GE(more, 100U);
  ASSERT_LT(more, 1000U);
  const std::string text = fmt::format("yet: about {:.0f}0 more seeds |", std::ceil(more / 10.0));
  EXPECT_THAT(format_comparison(runs, {}), HasSubstr(text));
}

// 3 of 20: Clopper and Pearson have 3.2 .. 37.9 %, 0 of 20 has 1 - 0.025^(1/20) = 16.8 %. McNemar:
// 2 / 2^3.
TEST(ComparisonReportTest, FailuresHaveExactIntervals) {
  EXPECT_THAT(format_comparison(passed_runs(), {}),
              HasSubstr("failing: A 3 of 20 seeds (3.2 .. 37.9 %), B 0 of 20 seeds (0.0 .. 16.8 "
                        "%); exact test of McNemar p = 0.25\n"));
  const Json failures = comparison_json(passed_runs(), {})["groups"][0]["failures"];
  EXPECT_EQ(failures["a"]["failed"], 3);
  EXPECT_NEAR(failures["a"]["interval"][1].get<double>(), 0.3789, 5e-5);
  EXPECT_NEAR(failures["p_mcnemar"].get<double>(), 0.25, 1e-12);
}

// Every number behind a verdict: 3 mm and 1 mm more in B.
TEST(ComparisonReportTest, TheDataHasAllNumbers) {
  PairedRuns runs;
  runs.pairs = test::run_pairs("/ate_rmse_m", {0.010, 0.020}, {0.013, 0.021});
  CompareSettings settings{.margins = parse_margins({"ate_rmse_m=5"}, "--margin")};
  const Json json = comparison_json(runs, settings);
  EXPECT_EQ(json["alpha"], 0.05);
  const Json& result = json["groups"][0]["metrics"][0];
  EXPECT_EQ(result["key"], "ate_rmse_m");
  EXPECT_EQ(result["method"], "difference");
  EXPECT_NEAR(result["effect"].get<double>(), 2, 1e-9);
  EXPECT_NEAR(result["difference"].get<double>(), 2, 1e-9);
  EXPECT_NEAR(result["spread"].get<double>(), std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(result["values_b"][1].get<double>(), 21, 1e-9);
  EXPECT_NEAR(result["differences"][0].get<double>(), 3, 1e-9);
  // t of one degree is Cauchy's: the ends are 2 +- tan(pi 0.475) = 2 +- 12.7062.
  EXPECT_NEAR(result["interval"][0].get<double>(), 2 - 12.7062, 1e-4);
  // t = 2: p = 1 - 2 atan(2) / pi; t = (2 - 5): 1/2 - atan(3) / pi.
  EXPECT_NEAR(result["p_difference"].get<double>(), 1 - 2 * std::atan(2) / M_PI, 1e-9);
  EXPECT_NEAR(result["p_equivalence"].get<double>(), 0.5 - std::atan(3) / M_PI, 1e-9);
  EXPECT_EQ(result["adjusted_p_difference"], result["p_difference"]);
  EXPECT_EQ(result["verdict"], "cannot tell yet");
  EXPECT_GT(result["pairs_needed"], 2);
}

TEST(ComparisonReportTest, HashesOfOtherEnvironmentsAreNotCompared) {
  PairedRuns runs;
  runs.pairs = test::run_pairs("/ate_rmse_m", {0.01, 0.02}, {0.01, 0.02});
  for (RunPair& pair : runs.pairs) {
    pair.before.repeats[0].json = pair.after.repeats[0].json = test::hash_json("a");
  }
  EXPECT_THAT(format_comparison(runs, {}),
              AllOf(HasSubstr("2 pairs; all runs are the same to the byte)"),
                    Not(HasSubstr("comparable"))));
  runs.pairs[1].after.repeats[0].json = test::hash_json("a", "glibc");
  EXPECT_THAT(format_comparison(runs, {}),
              AllOf(HasSubstr("hashes of A and B are not comparable: their environments differ in "
                              "libm\n"),
                    Not(HasSubstr("same to the byte"))));
  const Json json = comparison_json(runs, {});
  EXPECT_EQ(json["groups"][0]["identical"], false);
  EXPECT_EQ(json["hashes_not_comparable"], "their environments differ in libm");
}

TEST(ComparisonReportTest, RepeatsTellOfTheSystem) {
  PairedRuns runs = passed_runs();
  for (RunPair& pair : runs.pairs) {
    pair.before.repeats.push_back(pair.before.repeats[0]);
    pair.after.repeats.push_back(pair.after.repeats[0]);
    pair.after.repeats[1].values["/ate_rmse_m"] = 0.02;
  }
  EXPECT_THAT(format_comparison(runs, {}), HasSubstr("B: row, repeats of 20 seeds: "));
  EXPECT_EQ(comparison_json(runs, {})["repeats"]["b"][0]["runs"], 40);
}

}  // namespace
}  // namespace vinebench::harness
