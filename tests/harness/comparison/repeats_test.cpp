// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/comparison/repeats.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/compared_runs.h"

namespace vinebench::harness {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

StoredRun repeat(std::int64_t seed, double ate_m, bool ok, const std::string& hash,
                 const std::string& libm = "vinebench") {
  Json metrics{{"scenario", "row"},
               {"seed", seed},
               {"ate_rmse_m", ate_m},
               {"expectations", checks_json({{"losses", "", "", ok}})}};
  metrics.update(test::hash_json(hash, libm));
  return stored_run(metrics).value();
}

RepeatedSeed seed_of(std::int64_t seed, std::vector<StoredRun> repeats,
                     std::size_t without_results = 0) {
  return {{.scenario = "row", .seed = seed, .repeats = std::move(repeats)}, without_results};
}

// Flaky: 1 of 3 fails, Clopper and Pearson 0.8 .. 90.6 %. Broken: all, also those without results.
TEST(RepeatsTest, TellsFlakyFromBroken) {
  const auto summaries =
      summarise_repeats({seed_of(1, {repeat(1, 0.01, true, "a"), repeat(1, 0.01, true, "a")}),
                         seed_of(2, {repeat(2, 0.01, true, "b"), repeat(2, 0.02, false, "c"),
                                     repeat(2, 0.01, true, "b")}),
                         seed_of(3, {repeat(3, 0.01, false, "d")}, 1)});
  ASSERT_EQ(summaries.size(), 1u);
  const RepeatsSummary& summary = summaries[0];
  EXPECT_EQ(summary.seeds, 3u);
  EXPECT_EQ(summary.runs, 7u);
  ASSERT_EQ(summary.failing.size(), 2u);
  EXPECT_FALSE(summary.failing[0].broken());
  EXPECT_NEAR(summary.failing[0].rate.low, 0.0084, 5e-5);
  EXPECT_NEAR(summary.failing[0].rate.high, 0.9057, 5e-5);
  EXPECT_TRUE(summary.failing[1].broken());
  EXPECT_THAT(summary.differing, ElementsAre(2));
  EXPECT_FALSE(summary.deterministic());
  EXPECT_THAT(format_repeats(summaries),
              AllOf(HasSubstr("row, repeats of 3 seeds: repeats differ by hash in seed 2"),
                    HasSubstr("seed 2: flaky, 1 of 3 repeats fail (1 .. 91 %): losses\n"),
                    HasSubstr("seed 3: broken, 2 of 2 repeats fail"),
                    HasSubstr("losses, run without results\n")));
  const Json json = repeats_json(summaries)[0];
  EXPECT_EQ(json["failing"][0]["state"], "flaky");
  EXPECT_EQ(json["failing"][1]["state"], "broken");
}

TEST(RepeatsTest, ADeterministicSystemAgreesByHash) {
  const auto summaries =
      summarise_repeats({seed_of(1, {repeat(1, 0.01, true, "a"), repeat(1, 0.01, true, "a")}),
                         seed_of(2, {repeat(2, 0.02, true, "b"), repeat(2, 0.02, true, "b")})});
  EXPECT_TRUE(summaries.at(0).deterministic());
  EXPECT_THAT(format_repeats(summaries),
              AllOf(HasSubstr("repeats agree by hash"), Not(HasSubstr("between"))));
}

TEST(RepeatsTest, RepeatsOfOtherEnvironmentsDoNotTellByHash) {
  const auto summaries = summarise_repeats(
      {seed_of(1, {repeat(1, 0.01, true, "a"), repeat(1, 0.01, true, "a")}),
       seed_of(2, {repeat(2, 0.02, true, "b"), repeat(2, 0.02, true, "b", "x")})});
  EXPECT_FALSE(summaries.at(0).deterministic());
  EXPECT_TRUE(summaries[0].differing.empty());
  EXPECT_THAT(format_repeats(summaries),
              AllOf(HasSubstr("hashes are not comparable: their environments differ in libm\n"),
                    Not(HasSubstr("differ by hash"))));
  EXPECT_EQ(repeats_json(summaries)[0]["hashes_not_comparable"],
            "their environments differ in libm");
}

TEST(RepeatsTest, WithoutRepeatsThereIsNothingToSay) {
  EXPECT_TRUE(summarise_repeats({}).empty());
  EXPECT_TRUE(summarise_repeats({seed_of(1, {repeat(1, 0.01, true, "a")})}).empty());
  EXPECT_EQ(format_repeats(std::vector<RepeatsSummary>{}), "");
}

// Logarithms 0, ln 2 and ln 4, ln 8 (of 10 mm): mean squares (ln 2)^2 / 2 within and, of means that
// are 2 ln 2 apart, 4 (ln 2)^2 between; variances (4 - 1/2) / 2 (ln 2)^2 = 1.75 (ln 2)^2 between.
TEST(RepeatsTest, VariancesAreThoseOfLogarithms) {
  const auto summaries =
      summarise_repeats({seed_of(1, {repeat(1, 0.01, true, "a"), repeat(1, 0.02, true, "b")}),
                         seed_of(2, {repeat(2, 0.04, true, "c"), repeat(2, 0.08, true, "d")})});
  ASSERT_EQ(summaries.at(0).variances.size(), 1u);
  const MetricVariance& ate = summaries[0].variances[0];
  EXPECT_TRUE(ate.logarithmic);
  const double square = std::log(2.0) * std::log(2.0);
  EXPECT_NEAR(ate.components.within, square / 2, 1e-12);
  EXPECT_NEAR(ate.components.between, 1.75 * square, 1e-12);
  // exp(ln 2 / sqrt(2)) - 1 = 63.2 %, exp(ln 2 sqrt(1.75)) - 1 = 150.2 %, 0.5 / 2.25 = 22 %.
  EXPECT_THAT(format_repeats(summaries),
              AllOf(HasSubstr("63.3 %"), HasSubstr("150.2 %"), HasSubstr("22 % |")));
}

}  // namespace
}  // namespace vinebench::harness
