// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sets/set_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/compared_runs.h"
#include "tests/support/set_runs.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using test::crashed_run;
using test::set_run;
using testing::HasSubstr;
using testing::Not;

PlannedRun planned(const std::string& title, const ScenarioConfig& scenario) {
  PlannedRun run;
  run.title = title;
  run.settings = std::make_shared<const ScenarioConfig>(scenario);
  return run;
}

/// Summary of the scenario "row", of whose errors the median must be at most 15 mm.
SeedsSummary summary_of(std::vector<SetRun> runs) {
  ScenarioConfig scenario;
  scenario.expectations.median = {.ate_rmse_max = std::nullopt, .ate_origin_rmse_max = 0.015};
  SetOutcome outcome;
  outcome.runs = std::move(runs);
  return summarise({planned("row", scenario)}, outcome).at(0);
}

TEST(SetReportTest, TheMedianHasABoundOfItsOwn) {
  const SeedsSummary bad = summary_of({set_run(1, 0.03), set_run(2, 0.01), set_run(3, 0.02)});
  EXPECT_DOUBLE_EQ(bad.medians[0].value(), 20);  // mm
  ASSERT_EQ(bad.checks.size(), 1u);
  EXPECT_EQ(bad.checks[0].what, "median of 3 seeds: ATE, first pose aligned");
  EXPECT_EQ(bad.checks[0].measured, "0.0200 m");
  EXPECT_EQ(bad.checks[0].expected, "<= 0.0150 m");
  EXPECT_FALSE(bad.passed());
  EXPECT_TRUE(summary_of({set_run(1, 0.03), set_run(2, 0.01), set_run(3, 0.015)}).passed());
  EXPECT_TRUE(summary_of({set_run(1, 0.03), set_run(2, 0.03)}).checks.empty());  // too few seeds
}

// Of 3, 1 and 2 cm the median is 2 cm.
TEST(SetReportTest, TheMedianOfTheAlignedErrorHasOneToo) {
  const auto checks_below = [&](double limit) {
    ScenarioConfig scenario;
    scenario.expectations.median = {.ate_rmse_max = limit, .ate_origin_rmse_max = std::nullopt};
    SetOutcome outcome;
    for (const double error : {0.03, 0.01, 0.02}) {
      outcome.runs.push_back(set_run(static_cast<std::int64_t>(100 * error), 0.5));
      outcome.runs.back().result->values["/ate_rmse_m"] = error;
    }
    return summarise({planned("row", scenario)}, outcome).at(0).checks;
  };
  ASSERT_EQ(checks_below(0.02).size(), 1u);
  EXPECT_EQ(checks_below(0.02)[0].what, "median of 3 seeds: ATE, SE(3)-aligned");
  EXPECT_TRUE(checks_below(0.02)[0].ok);
  EXPECT_FALSE(checks_below(0.019)[0].ok);
}

// The table's median is of the runs that have an error; the check counts the others as infinite.
TEST(SetReportTest, ARunWithoutAnErrorIsInfinite) {
  const SeedsSummary one = summary_of({set_run(1, 0.01), crashed_run(2), set_run(3, 0.02)});
  EXPECT_DOUBLE_EQ(one.medians[0].value(), 15);
  EXPECT_EQ(one.checks.at(0).measured, "0.0200 m");
  const SeedsSummary two = summary_of({set_run(1, 0.01), crashed_run(2), crashed_run(3)});
  EXPECT_EQ(two.checks.at(0).measured, "none");
  EXPECT_FALSE(two.checks[0].ok);
}

TEST(SetReportTest, ScenariosKeepTheirOrder) {
  const std::vector<PlannedRun> plan{planned("row", {}), planned("loop", {})};
  SetRun other = set_run(1, 0.01);
  other.scenario = "loop";
  SetOutcome outcome;
  outcome.runs = {set_run(1, 0.01), set_run(2, 0.01), other};
  const auto scenarios = summarise(plan, outcome);
  ASSERT_EQ(scenarios.size(), 2u);
  EXPECT_EQ(scenarios[0].runs.size(), 2u);
  EXPECT_EQ(scenarios[1].scenario, "loop");
}

TEST(SetReportTest, TheTableHasARowForEachRunAndTheMedian) {
  const std::string table =
      format_table({summary_of({set_run(1, 0.01), set_run(2, 0.02, false), crashed_run(3)})});
  EXPECT_EQ(std::ranges::count(table, '\n'), 6);  // header, rule, three runs, median
  EXPECT_THAT(table, HasSubstr("| row      | 1      |          10.00 |"));
  EXPECT_THAT(table, HasSubstr("|  passed |\n"));
  EXPECT_THAT(table, HasSubstr("|  FAILED |\n"));
  EXPECT_THAT(table, HasSubstr("| row      | 3      |              – |"));
  EXPECT_THAT(table, HasSubstr("|   ERROR |\n"));
  EXPECT_THAT(table, HasSubstr("| row      | median |          15.00 |"));
  EXPECT_THAT(format_table({summary_of({set_run(1, 0.01)})}), Not(HasSubstr("median")));
}

/// The repeat of a run of three, with a hash.
SetRun repeat_run(std::int64_t seed, int repeat, double ate, const std::string& hash) {
  SetRun run = set_run(seed, ate);
  run.repeat = repeat;
  run.repeats = 3;
  run.result->json.update(test::hash_json(hash));
  return run;
}

/// Three repeats of seeds 1 to 3; the second seed's differ.
std::vector<SetRun> repeated_runs() {
  return {repeat_run(1, 1, 0.010, "a"), repeat_run(1, 2, 0.010, "a"), repeat_run(1, 3, 0.010, "a"),
          repeat_run(2, 1, 0.016, "b"), repeat_run(2, 2, 0.018, "c"), repeat_run(2, 3, 0.012, "d"),
          repeat_run(3, 1, 0.030, "e"), repeat_run(3, 2, 0.030, "e"), repeat_run(3, 3, 0.030, "e")};
}

// The seeds' medians are 10, 16 and 30 mm.
TEST(SetReportTest, ASeedCountsOnce) {
  const SeedsSummary summary = summary_of(repeated_runs());
  EXPECT_DOUBLE_EQ(summary.medians[0].value(), 16);
  EXPECT_EQ(summary.checks.at(0).what, "median of 3 seeds: ATE, first pose aligned");
  EXPECT_EQ(summary.checks[0].measured, "0.0160 m");
  EXPECT_THAT(format_table({summary}), HasSubstr("| row      | 2 (3)  |          12.00 |"));
  EXPECT_EQ(summary_json({summary})["scenarios"][0]["runs"][5]["repeat"], 3);
}

TEST(SetReportTest, TheBuiltInSystemsRepeatsMustAgree) {
  const SeedsSummary differing = summary_of(repeated_runs());
  ASSERT_EQ(differing.repeat_checks.size(), 1u);
  EXPECT_EQ(differing.repeat_checks[0].measured, "1 seeds differ");
  EXPECT_FALSE(differing.passed());
  EXPECT_THAT(format_failures({differing}), HasSubstr("repeats agree by hash  1 seeds differ"));
  EXPECT_THAT(format_repeats(std::vector{differing}),
              HasSubstr("row, repeats of 3 seeds: repeats differ by hash in seed 2"));
  std::vector<SetRun> equal = repeated_runs();
  equal.erase(equal.begin() + 3, equal.begin() + 6);
  EXPECT_TRUE(summary_of(equal).repeat_checks.at(0).ok);
  EXPECT_THAT(format_repeats(std::vector{summary_of(equal)}), HasSubstr("repeats agree by hash"));
}

TEST(SetReportTest, RepeatsOfOtherEnvironmentsAreNotSaidToAgree) {
  std::vector<SetRun> runs = repeated_runs();
  runs.resize(3);
  EXPECT_TRUE(summary_of(runs).repeat_checks.at(0).ok);
  runs[1].result->json.update(test::hash_json("a", "glibc"));
  const Check check = summary_of(runs).repeat_checks.at(0);
  EXPECT_FALSE(check.ok);
  EXPECT_EQ(check.measured, "their environments differ in libm");
}

TEST(SetReportTest, OtherSystemsMayDiffer) {
  ScenarioConfig scenario;
  scenario.slam.plugin.emplace().library = "slam.so";
  SetOutcome outcome;
  outcome.runs = repeated_runs();
  const SeedsSummary summary = summarise({planned("row", scenario)}, outcome).at(0);
  EXPECT_TRUE(summary.repeat_checks.empty());
  EXPECT_TRUE(summary.passed());
  EXPECT_EQ(summary_json({summary})["scenarios"][0]["repeats"]["deterministic"], false);
}

// A repeat that crashed beside two that passed.
TEST(SetReportTest, ACrashedRepeatIsFlaky) {
  std::vector<SetRun> runs = repeated_runs();
  runs[1].result.reset();
  runs[1].error = "ended by signal 9";
  const SeedsSummary summary = summary_of(runs);
  ASSERT_EQ(summary.repeats.value().failing.size(), 1u);
  EXPECT_EQ(summary.repeats->failing[0].failed, 1u);
  EXPECT_THAT(format_failures({summary}), HasSubstr("row, seed 1, repeat 2: ended by signal 9"));
}

TEST(SetReportTest, FailuresSayWhatFailedAndWhereTheLogIs) {
  const test::TestFolder folder;
  SetRun crashed = crashed_run(3);
  crashed.folder = folder.path();
  const auto text = [&] {
    return format_failures({summary_of({set_run(1, 0.01), set_run(2, 0.02, false), crashed})});
  };
  EXPECT_THAT(text(), Not(HasSubstr("seed 1")));
  EXPECT_THAT(text(), HasSubstr("row, seed 2 (out/row/seed-2):\n  losses  2  <= 0  FAILED\n"));
  EXPECT_THAT(text(), HasSubstr("row, seed 3: ended by signal 9\n"));
  EXPECT_THAT(text(), HasSubstr("row:\n  median of 3 seeds"));
  const auto log = folder.write("log.txt", "");
  EXPECT_THAT(text(), HasSubstr("ended by signal 9; see " + log.string()));
  EXPECT_EQ(format_failures({summary_of({set_run(1, 0.01)})}), "");
}

TEST(SetReportTest, TheSummaryHasTheRunsMetrics) {
  const Json json =
      summary_json({summary_of({set_run(1, 0.01), set_run(2, 0.02, false), crashed_run(3)})});
  EXPECT_EQ(json["passed"], false);
  const Json& row = json["scenarios"][0];
  EXPECT_EQ(row["median"]["ATE origin, mm"], 15);
  EXPECT_EQ(row["expectations_of_median"].size(), 1u);
  EXPECT_EQ(row["runs"][0]["verdict"], "passed");
  EXPECT_EQ(row["runs"][0]["metrics"]["ate_origin_rmse_m"], 0.01);
  EXPECT_TRUE(row["runs"][0]["error"].is_null());
  EXPECT_EQ(row["runs"][1]["verdict"], "FAILED");
  EXPECT_EQ(row["runs"][2]["verdict"], "ERROR");
  EXPECT_TRUE(row["runs"][2]["metrics"].is_null());
}

}  // namespace
}  // namespace vinebench::harness
