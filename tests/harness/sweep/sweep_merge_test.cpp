// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sweep/sweep_merge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/files/files.h"
#include "harness/sets/set_report.h"
#include "harness/sweep/shards.h"
#include "tests/support/fake_sweep.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using test::error_of;
using testing::ElementsAre;
using testing::HasSubstr;

class SweepMergeTest : public testing::Test {
 protected:
  /// Runs a part of the plan into a folder.
  void run(const Shard& shard, const std::string& folder) const {
    std::vector<double> costs;
    for (const SweepTask& task : plan_.tasks) costs.push_back(task.cost);
    SetOptions options;
    options.run = test::run_fake;
    const auto runs =
        planned_runs(plan_, tasks_of(shard, costs), test::load_fake, folder_ / folder);
    for (const SetRun& done : run_set(runs, options).runs) EXPECT_EQ(done.error, "");
  }
  MergedSweep merge(const std::vector<std::string>& names) const {
    std::vector<fs::path> folders;
    for (const std::string& name : names) folders.push_back(folder_ / name);
    return merge_sweep(plan_, folders, test::load_fake);
  }
  std::string table(const MergedSweep& merged) const {
    return format_table(summarise(merged.plan, merged.outcome), TableColumns::kOfEstimate);
  }
  std::string error(const std::vector<std::string>& names) const {
    return error_of([&] { merge(names); });
  }
  /// A file of the first task's result.
  fs::path file_of(const std::string& folder, const char* name) const {
    return folder_ / folder / plan_.tasks[0].folder / name;
  }

  test::TestFolder folder_;
  SweepPlan plan_ = test::fake_plan();
};

TEST_F(SweepMergeTest, TheTableIsTheSameWhateverTheShardsAndTheirOrder) {
  run({1, 1}, "whole");
  for (int i = 1; i <= 3; ++i) run({i, 3}, "part" + std::to_string(i));
  const MergedSweep whole = merge({"whole"});
  const MergedSweep parts = merge({"part3", "part1", "part2"});
  EXPECT_TRUE(parts.missing.empty());
  EXPECT_EQ(table(parts), table(whole));
  EXPECT_EQ(format_csv(plan_, parts), format_csv(plan_, whole));
  EXPECT_EQ(std::ranges::count(table(whole), '\n'), 2 + 12 + 4);  // head, runs, medians
  EXPECT_EQ(format_missing(whole), "");
}

// With nothing but scenarios and seeds it is what `run --seeds` has.
TEST_F(SweepMergeTest, TheTableIsThatOfASet) {
  SweepSpec spec;
  spec.scenarios = {"row", "loop"};
  spec.seeds = "1..3";
  plan_ = make_plan(spec, test::load_fake, [](const auto&) { return 1.0; });
  run({1, 2}, "sweep");
  run({2, 2}, "sweep");
  SetOptions options;
  options.run = test::run_fake;
  const auto plan = plan_set({test::load_fake("row", {}), test::load_fake("loop", {})}, {1, 2, 3},
                             folder_ / "set");
  const auto summary = summarise(plan, run_set(plan, options));
  EXPECT_EQ(table(merge({"sweep"})), format_table(summary, TableColumns::kOfEstimate));
}

TEST_F(SweepMergeTest, WhatIsMissingIsNamed) {
  run({1, 2}, "part");  // every second one
  fs::remove(file_of("part", kInputsFile));
  const MergedSweep merged = merge({"part"});
  EXPECT_EQ(merged.missing.size(), 7u);
  EXPECT_EQ(merged.missing[0], 0u);  // without its last file a result is not whole
  EXPECT_THAT(format_missing(merged),
              HasSubstr("7 of 12 runs are missing:\n  row, speed=1, seed 1\n"));
  EXPECT_THAT(table(merged), HasSubstr("missing |\n"));
  EXPECT_FALSE(summarise(merged.plan, merged.outcome).at(0).passed());
}

TEST_F(SweepMergeTest, OtherInputsAreRefused) {
  run({1, 1}, "part");
  write_file_atomically(file_of("part", "inputs.txt"), "0\n");
  EXPECT_THAT(error({"part"}), HasSubstr("seed-1: a result of other inputs than the plan's"));
}

TEST_F(SweepMergeTest, AResultWithoutItsHashIsRefused) {
  run({1, 1}, "part");
  const fs::path file = file_of("part", "metrics.json");
  Json json = Json::parse(read_file(file));
  json.erase("hash");
  write_file_atomically(file, json.dump());
  EXPECT_THAT(error({"part"}), HasSubstr("seed-1: metrics.json: has no hash"));
}

TEST_F(SweepMergeTest, ResultsThatDifferAreRefused) {
  run({1, 1}, "a");
  run({1, 1}, "b");
  EXPECT_EQ(error({"a", "b"}), "");  // twice the same
  const fs::path file = file_of("b", "metrics.json");
  Json json = Json::parse(read_file(file));
  json["hash"] = "0";
  write_file_atomically(file, json.dump());
  EXPECT_THAT(error({"a", "b"}),
              HasSubstr("b/speed=1/row/seed-1: another result of the same run than in"));
}

TEST_F(SweepMergeTest, OtherEnvironmentsAreRefused) {
  run({1, 1}, "part");
  const fs::path file = file_of("part", "metrics.json");
  Json json = Json::parse(read_file(file));
  json["hash_environment"]["libm"] = "another";
  write_file_atomically(file, json.dump());
  // The first result is what the other eleven differ from; ten are named.
  const std::string message = error({"part"});
  EXPECT_THAT(message, HasSubstr("where libm is another than for"));
  EXPECT_THAT(message, HasSubstr("\nand 1 more"));
}

// The renderers of a grid have libraries of their own.
TEST_F(SweepMergeTest, AnotherRendererMayHaveAnotherEnvironment) {
  const auto load = [](const std::string& name, const std::vector<Override>& overrides) {
    ScenarioConfig scenario = test::load_fake(name, overrides);
    scenario.simulation.renderer.lod_scale = *scenario.simulation.duration;
    return scenario;
  };
  SweepSpec spec;
  spec.scenarios = {"row"};
  spec.grid = {{"speed", {"1", "2"}}};
  plan_ = make_plan(spec, load, [](const auto&) { return 1.0; });
  SetOptions options;
  options.run = test::run_fake;
  run_set(planned_runs(plan_, {0, 1}, load, folder_ / "part"), options);
  const fs::path file = file_of("part", "metrics.json");
  Json json = Json::parse(read_file(file));
  json["hash_environment"]["libm"] = "another";
  write_file_atomically(file, json.dump());
  EXPECT_TRUE(merge_sweep(plan_, {folder_ / "part"}, load).missing.empty());
}

TEST_F(SweepMergeTest, RowsHaveTheEstimatesMetricsAlone) {
  run({1, 1}, "part");
  const std::string csv = format_csv(plan_, merge({"part"}));
  const std::string head = csv.substr(0, csv.find('\n'));
  EXPECT_THAT(head, testing::StartsWith("scenario,system,speed,seed,repeat,verdict,hash,passed,"));
  EXPECT_EQ(head.find("cpu_seconds"), std::string::npos);
  EXPECT_EQ(std::ranges::count(csv, '\n'), 13);
  EXPECT_THAT(csv, HasSubstr("\nloop,,2,3,1,"));
}

}  // namespace
}  // namespace vinebench::harness
