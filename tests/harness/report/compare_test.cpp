// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/report/compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using testing::AllOf;
using testing::HasSubstr;

StoredRun run(int seed, double ate_m, const char* scenario = "row") {
  return stored_run({{"scenario", scenario},
                     {"seed", seed},
                     {"ate_rmse_m", ate_m},
                     {"coverage", 1.0},
                     {"losses", 0},
                     {"real_time_factor", 0.5},
                     {"rpe_trans_percent", {}}})
      .value();
}

/// The change of the ATE from some values to others, m.
MetricChange ate_change(const std::vector<double>& before, const std::vector<double>& after) {
  std::vector<RunPair> pairs;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const int seed = static_cast<int>(i);
    pairs.push_back({run(seed, before[i]), run(seed, after[i])});
  }
  return compare_metrics(pairs).front();
}

// Differences 1, 2, 3 mm: mean 2, standard deviation 1, t of two degrees 4.303: 4.303 / sqrt(3) =
// 2.484, so the interval contains zero.
TEST(CompareTest, AnIntervalThatHoldsZeroIsTheSame) {
  const MetricChange change = ate_change({0.010, 0.011, 0.012}, {0.011, 0.013, 0.015});
  EXPECT_EQ(change.metric.title, "ATE, mm");
  EXPECT_EQ(change.pairs, 3u);
  EXPECT_NEAR(change.before, 11, 1e-9);
  EXPECT_NEAR(change.difference(), 2, 1e-9);
  EXPECT_NEAR(change.half_width.value(), 4.303 / std::sqrt(3.0), 1e-9);
  EXPECT_EQ(change.change, Change::kSame);
}

// Differences 2, 2.1, 1.9 mm: standard deviation 0.1, half width 0.248: the interval excludes zero.
TEST(CompareTest, PairsTakeOutWhatSeedsHaveInCommon) {
  EXPECT_EQ(ate_change({0.01, 0.05, 0.2}, {0.012, 0.0521, 0.2019}).change, Change::kWorse);
  EXPECT_EQ(ate_change({0.012, 0.0521, 0.2019}, {0.01, 0.05, 0.2}).change, Change::kBetter);
}

TEST(CompareTest, OnePairGivesNoInterval) {
  const MetricChange change = ate_change({0.01}, {0.02});
  EXPECT_FALSE(change.half_width);
  EXPECT_EQ(change.change, Change::kUnknown);
  EXPECT_EQ(ate_change({0.01}, {0.01}).change, Change::kSame);
  EXPECT_EQ(ate_change({0.01, 0.02}, {0.01, 0.02}).change, Change::kSame);
}

TEST(CompareTest, TheOverallVerdictIsThatOfTheEstimate) {
  const auto changes = [](Change ate, Change coverage, Change speed) {
    const Metric cost{.of_estimate = false};
    return std::vector<MetricChange>{
        {.change = ate}, {.change = coverage}, {.metric = cost, .change = speed}};
  };
  using enum Change;
  EXPECT_EQ(overall(changes(kSame, kSame, kWorse)), kSame);
  EXPECT_EQ(overall(changes(kBetter, kSame, kWorse)), kBetter);
  EXPECT_EQ(overall(changes(kSame, kWorse, kBetter)), kWorse);
  EXPECT_EQ(overall(changes(kBetter, kWorse, kSame)), kMixed);
  EXPECT_EQ(overall(changes(kUnknown, kSame, kSame)), kUnknown);
}

TEST(CompareTest, RunsArePairedByScenarioAndSeed) {
  const test::TestFolder folder;
  const auto write = [&](const std::string& place, const StoredRun& run) {
    std::filesystem::create_directories(folder / place);
    folder.write(place + "/metrics.json", run.json.dump());
  };
  write("a/row/seed-1", run(1, 0.01));
  write("a/row/seed-2", run(2, 0.01));
  write("a/loop/seed-1", run(1, 0.03, "loop"));
  write("b/anything/2", run(2, 0.02));
  write("b/anything/1", run(1, 0.02, "loop"));
  write("b/anything/3", run(3, 0.02));
  const PairedRuns runs = pair_runs(folder / "a", folder / "b");
  ASSERT_EQ(runs.pairs.size(), 2u);
  EXPECT_EQ(runs.pairs[0].before.scenario, "loop");
  EXPECT_EQ(runs.pairs[1].before.seed, 2);
  EXPECT_EQ(runs.unpaired.size(), 2u);
  EXPECT_THAT(format_comparison(runs),
              AllOf(HasSubstr("all scenarios"), HasSubstr("not compared: row, seed 1 (only in")));
  const Json json = comparison_json(runs);
  EXPECT_EQ(json["groups"].size(), 3u);  // loop, row, all
  EXPECT_NEAR(json["groups"][0]["figures"][0]["difference"].get<double>(), -10, 1e-9);  // mm

  EXPECT_THAT(test::error_of([&] { pair_runs(folder / "a/loop", folder / "b/anything/2"); }),
              HasSubstr("no scenario and seed is in both"));
  EXPECT_THAT(test::error_of([&] { pair_runs(folder / "none", folder / "b"); }),
              HasSubstr("none: expected a folder of runs"));
  std::filesystem::create_directories(folder / "empty");
  EXPECT_THAT(test::error_of([&] { pair_runs(folder / "a", folder / "empty"); }),
              HasSubstr("empty: contains no run"));
  write("b/again", run(2, 0.02));
  EXPECT_THAT(test::error_of([&] { pair_runs(folder / "a", folder / "b"); }),
              HasSubstr("row, seed 2 is duplicate"));
  folder.write("b/again/metrics.json", "{");
  EXPECT_THAT(test::error_of([&] { pair_runs(folder / "a", folder / "b"); }),
              HasSubstr("is not a metrics.json of a run"));
}

TEST(CompareTest, RunsOfDifferentLengthsAreNoPair) {
  const test::TestFolder folder;
  const auto write = [&](const std::string& place, int seed, int frames) {
    std::filesystem::create_directories(folder / place);
    Json json = run(seed, 0.01).json;
    json["frames"] = frames;
    folder.write(place + "/metrics.json", json.dump());
  };
  write("a/1", 1, 150);
  write("b/1", 1, 22);
  EXPECT_THAT(test::error_of([&] { pair_runs(folder / "a", folder / "b"); }),
              AllOf(HasSubstr("no two runs are of the same length"),
                    HasSubstr("row, seed 1 (A has 150 frames, B has 22)")));
  write("a/2", 2, 150);
  write("b/2", 2, 150);
  const PairedRuns runs = pair_runs(folder / "a", folder / "b");
  EXPECT_EQ(runs.pairs.size(), 1u);
  EXPECT_THAT(format_comparison(runs),
              HasSubstr("not compared: row, seed 1 (A has 150 frames, B has 22)"));
}

// What a comparison is about, files in other folders and keys of one side alone are no difference.
TEST(CompareTest, AnotherExperimentIsAWarning) {
  const test::TestFolder folder;
  const auto write = [&](const std::string& place, const std::string& settings) {
    std::filesystem::create_directories(folder / place);
    folder.write(place + "/metrics.json", run(1, 0.01).json.dump());
    folder.write(place + "/scenario.resolved.yaml", settings);
  };
  write("a", "slam: {cameras: [front]}\nrover: {model: /x/rover.xml}\nworld: {sun: 20, rows: [1]}");
  write("b",
        "slam: {cameras: [back]}\nrover: {model: /y/rover.xml}\nworld: {sun: 20, rows: [1], "
        "wind: 2}");
  EXPECT_TRUE(pair_runs(folder / "a", folder / "b").differing.empty());
  write("b", "world: {sun: 30, rows: [1, 2]}");
  const PairedRuns runs = pair_runs(folder / "a", folder / "b");
  EXPECT_THAT(runs.differing, testing::ElementsAre("row, seed 1: world.sun, world.rows"));
  EXPECT_THAT(format_comparison(runs), HasSubstr("not the same experiment: row, seed 1"));
  write("b", "world: [");
  EXPECT_THAT(test::error_of([&] { pair_runs(folder / "a", folder / "b"); }),
              HasSubstr("scenario.resolved.yaml: is not valid YAML"));
}

// Reference values of the distribution's 97.5 % quantile: 2.0395 (31), 1.9840 (100), 1.9600 (inf).
TEST(StudentTest, JoinsItsTableAndTheNormalDistribution) {
  EXPECT_EQ(student_t_95(4), 2.776);
  EXPECT_NEAR(student_t_95(31), 2.0395, 1e-3);
  EXPECT_NEAR(student_t_95(100), 1.9840, 1e-4);
  EXPECT_NEAR(student_t_95(1'000'000), 1.9600, 1e-4);
}

}  // namespace
}  // namespace vinebench::harness
