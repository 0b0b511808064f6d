// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/comparison/paired_runs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

StoredRun run(int seed, double ate_m, const char* scenario = "row") {
  return stored_run({{"scenario", scenario}, {"seed", seed}, {"ate_rmse_m", ate_m}}).value();
}

TEST(PairedRunsTest, RunsArePairedByScenarioAndSeed) {
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
  EXPECT_THAT(runs.unpaired, Contains(HasSubstr("row, seed 1 (only in")));
  const auto groups = groups_of(runs);
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_EQ(groups[0].first, "loop");
  EXPECT_EQ(groups[2].first, "all scenarios");
  EXPECT_EQ(groups[2].second.size(), 2u);

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

TEST(PairedRunsTest, RunsOfDifferentLengthsAreNoPair) {
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
  EXPECT_THAT(runs.unpaired, ElementsAre("row, seed 1 (A has 150 frames, B has 22)"));
}

// What a comparison is about, files in other folders and keys of one side alone are no difference.
TEST(PairedRunsTest, AnotherExperimentIsAWarning) {
  const test::TestFolder folder;
  const auto write = [&](const std::string& place, const std::string& settings) {
    std::filesystem::create_directories(folder / place);
    folder.write(place + "/metrics.json", run(1, 0.01).json.dump());
    folder.write(place + "/scenario.resolved.yaml", settings);
  };
  write("a",
        "slam: {cameras: [front]}\ngoal: {losses_max: 0}\nguard: {losses_max: 1}\nrover: {model: "
        "/x/rover.xml}\nworld: {sun: 20, rows: [1]}");
  write("b",
        "slam: {cameras: [back]}\ngoal: {losses_max: 2}\nguard: {losses_max: 3}\nrover: {model: "
        "/y/rover.xml}\nworld: {sun: 20, rows: [1], "
        "wind: 2}");
  EXPECT_TRUE(pair_runs(folder / "a", folder / "b").differing.empty());
  write("b", "world: {sun: 30, rows: [1, 2]}");
  const PairedRuns runs = pair_runs(folder / "a", folder / "b");
  EXPECT_THAT(runs.differing, ElementsAre("row, seed 1: world.sun, world.rows"));
  write("b", "world: [");
  EXPECT_THAT(test::error_of([&] { pair_runs(folder / "a", folder / "b"); }),
              HasSubstr("scenario.resolved.yaml: is not valid YAML"));
}

/// Writes runs into a folder.
class RepeatedRunsTest : public testing::Test {
 protected:
  void write(const std::string& place, Json metrics) {
    std::filesystem::create_directories(folder_ / place);
    folder_.write(place + "/metrics.json", metrics.dump());
  }
  test::TestFolder folder_;
};

TEST_F(RepeatedRunsTest, FoldersBelowAreRepeats) {
  write("a/row/seed-1", run(1, 0.01).json);
  write("a/row/seed-1/repeat-10", run(1, 0.10).json);
  write("a/row/seed-1/repeat-2", run(1, 0.02).json);
  write("a/row/seed-2", run(2, 0.05).json);
  const std::vector<SeedRuns> runs = find_runs(folder_ / "a");
  ASSERT_EQ(runs.size(), 2u);
  ASSERT_EQ(runs[0].repeats.size(), 3u);
  EXPECT_EQ(runs[0].folder, folder_ / "a/row/seed-1");
  EXPECT_EQ(runs[0].repeats[1].value("/ate_rmse_m"), 0.02);
  EXPECT_EQ(runs[0].repeats[2].value("/ate_rmse_m"), 0.10);
  write("a/again/repeat-3", run(1, 0.02).json);
  EXPECT_THAT(test::error_of([&] { find_runs(folder_ / "a"); }),
              HasSubstr("row, seed 1 is duplicate"));
}

// Of three repeats and two, two each.
TEST_F(RepeatedRunsTest, BothSidesHaveAsManyRepeats) {
  write("a", run(1, 0.01).json);
  write("a/repeat-2", run(1, 0.04).json);
  write("a/repeat-3", run(1, 0.04).json);
  write("b", run(1, 0.01).json);
  write("b/repeat-2", run(1, 0.01).json);
  const PairedRuns runs = pair_runs(folder_ / "a", folder_ / "b");
  EXPECT_EQ(runs.pairs.at(0).before.repeats.size(), 2u);
  EXPECT_EQ(runs.pairs.at(0).after.repeats.size(), 2u);
  EXPECT_THAT(runs.unpaired, ElementsAre(HasSubstr("row, seed 1: 1 of the 3 repeats in")));
}

// Geometric mean of 10 and 40 mm, arithmetic mean of 1 and 0 losses.
TEST_F(RepeatedRunsTest, ASeedHasTheMeanOfItsRepeats) {
  SeedRuns runs{.scenario = "row", .repeats = {run(1, 0.01), run(1, 0.04)}};
  EXPECT_NEAR(value_of(metric_named("ate_rmse_m"), runs).value(), 20, 1e-9);
  runs.repeats[0].values["/losses"] = 1;
  runs.repeats[1].values["/losses"] = 0;
  EXPECT_EQ(value_of(metric_named("losses"), runs), 0.5);
  EXPECT_FALSE(value_of(metric_named("coverage"), runs));
}

// Its frames end where the system did; that it did not pass is all that is compared.
TEST_F(RepeatedRunsTest, AFailedSystemIsAPairThatDidNotPass) {
  Json whole = run(1, 0.01).json;
  whole["frames"] = 150;
  whole["expectations"] = checks_json({{"losses", "0", "<= 0", true}});
  Json failed = whole;
  failed["frames"] = 3;
  failed["failure"] = {{"cause", "crashed"}, {"frame", 3}};
  failed["expectations"] = checks_json({{"slam.so", "crashed", "runs", false}});
  write("a", whole);
  write("b", failed);
  const PairedRuns runs = pair_runs(folder_ / "a", folder_ / "b");
  ASSERT_EQ(runs.pairs.size(), 1u);
  EXPECT_EQ(value_of(metric_named("passed"), runs.pairs[0].before), 100);
  EXPECT_EQ(value_of(metric_named("passed"), runs.pairs[0].after), 0);
  EXPECT_TRUE(value_of(metric_named("ate_rmse_m"), runs.pairs[0].before));
  EXPECT_FALSE(value_of(metric_named("ate_rmse_m"), runs.pairs[0].after));
}

}  // namespace
}  // namespace vinebench::harness
