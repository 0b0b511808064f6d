// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sets/run_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <sstream>

#include "core/util/error.h"
#include "harness/run/system_failure.h"
#include "tests/support/fake_scenario.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using testing::HasSubstr;

class RunSetTest : public testing::Test {
 protected:
  RunSetTest() { options_.run = test::run_fake; }

  std::vector<PlannedRun> plan(const std::vector<std::int64_t>& seeds) const {
    return plan_set({scenario_}, seeds, folder_.path(), repeats_);
  }
  std::vector<SetRun> run(const std::vector<std::int64_t>& seeds) {
    std::ostringstream progress;
    options_.progress = &progress;
    outcome_ = run_set(plan(seeds), options_);
    progress_ = progress.str();
    return outcome_.runs;
  }

  test::TestFolder folder_;
  ScenarioConfig scenario_ = test::fake_scenario();
  SetOptions options_;
  int repeats_ = 1;
  SetOutcome outcome_;
  std::string progress_;
};

/// Its fourth frame is too much for it.
RunOutcome break_down(const ScenarioConfig& scenario, int, const RunOptions& options) {
  test::FakeSource source;
  test::FakeSlam slam([](Estimate& estimate) {
    if (estimate.stamp == test::seconds(0.3)) fail_system("slam.so: process: crashed");
  });
  return run_lockstep_and_judge(trial_of(scenario), source, slam, options);
}

// A failure is a result: were it repeated until it succeeds, as often as a set is continued, no
// rate of failures could be measured.
TEST_F(RunSetTest, AFailedSystemFailsItsRunAndIsKept) {
  options_.run = break_down;
  for (const bool kept : {false, true}) {
    const SetRun first = run({1}).at(0);
    EXPECT_EQ(first.error, "");
    EXPECT_EQ(first.kept, kept);
    EXPECT_TRUE(first.failed());
    EXPECT_EQ(first.result.value().checks.at(0).measured, "slam.so: process: crashed (frame 3)");
    options_.run = test::run_fake;  // as a system that crashes now and then
  }
  EXPECT_THAT(progress_, HasSubstr("FAILED (kept)"));
  options_.force = true;
  EXPECT_FALSE(run({1}).at(0).failed());
}

TEST_F(RunSetTest, PlansEachScenarioOverTheSeeds) {
  ScenarioConfig other = scenario_;
  other.name = "other";
  other.seed = 9;
  const auto over_seeds = plan_set({scenario_, other}, {4, 2}, "out");
  ASSERT_EQ(over_seeds.size(), 4u);
  EXPECT_EQ(over_seeds[1].folder, "out/fake/seed-2");
  EXPECT_EQ(over_seeds[2].seed, 4);
  EXPECT_EQ(over_seeds[2].folder, "out/other/seed-4");
  const auto own = plan_set({scenario_, other}, {}, "out");
  ASSERT_EQ(own.size(), 2u);
  EXPECT_EQ(own[1].folder, "out/other/seed-9");
  EXPECT_THAT(test::error_of([&] {
                plan_set({scenario_, scenario_}, {}, "out");
              }),
              HasSubstr("the name 'fake'"));
}

TEST_F(RunSetTest, RepeatsAreBelowTheFirst) {
  repeats_ = 3;
  const auto runs = plan({4, 2});
  ASSERT_EQ(runs.size(), 6u);
  EXPECT_EQ(runs[0].folder, folder_ / "fake/seed-4");
  EXPECT_EQ(runs[2].folder, folder_ / "fake/seed-4/repeat-3");
  EXPECT_EQ(runs[2].repeat, 3);
  EXPECT_EQ(runs[2].scenario().seed, 4);
  EXPECT_EQ(runs[3].folder, folder_ / "fake/seed-2");
  EXPECT_EQ(seed_text(4, 3, 3), "seed 4, repeat 3");
  EXPECT_EQ(seed_text(4, 1, 1), "seed 4");
}

// What is there is kept when a set is given more repeats, or fewer.
TEST_F(RunSetTest, ASetCanBeGivenMoreRepeats) {
  run({1});
  repeats_ = 3;
  options_.jobs = 2;
  const auto runs = run({1});
  ASSERT_EQ(runs.size(), 3u);
  EXPECT_TRUE(runs[0].kept);
  for (const SetRun& run : runs) {
    EXPECT_EQ(run.error, "");
    EXPECT_EQ(run.result.value().hash(), runs[0].result->hash());
  }
  EXPECT_THAT(progress_, HasSubstr("fake, seed 1, repeat 3: passed"));
  repeats_ = 2;
  EXPECT_TRUE(run({1})[1].kept);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "fake/seed-1/repeat-3/metrics.json"));
}

// Comparisons would take it for a repeat of the same system.
TEST_F(RunSetTest, RepeatsOfOtherInputsAreRemoved) {
  repeats_ = 2;
  run({1});
  repeats_ = 1;
  scenario_.slam.tracking.radius += 1;
  run({1});
  EXPECT_FALSE(std::filesystem::exists(folder_ / "fake/seed-1/repeat-2/metrics.json"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "fake/seed-1/metrics.json"));
}

TEST_F(RunSetTest, RepeatsAreNotRemovedThroughLinks) {
  std::filesystem::create_directories(folder_ / "fake/seed-1");
  std::filesystem::create_directories(folder_ / "theirs/repeat-3");
  const auto linked = folder_.write("theirs/metrics.json", "{}");
  const auto below = folder_.write("theirs/repeat-3/metrics.json", "{}");
  std::filesystem::create_directory_symlink(folder_ / "theirs", folder_ / "fake/seed-1/repeat-2");
  std::filesystem::create_directory_symlink(folder_ / "theirs", folder_ / "fake/seed-2");
  repeats_ = 2;
  const auto runs = run({1, 2});
  EXPECT_EQ(runs[0].error, "");
  for (const std::size_t i : {1, 2, 3}) EXPECT_THAT(runs[i].error, HasSubstr("is a link")) << i;
  EXPECT_TRUE(std::filesystem::exists(linked));
  EXPECT_TRUE(std::filesystem::exists(below));
}

// All but the first of 201 poses are 0.01 m times the seed too high.
TEST_F(RunSetTest, RunsEverySeedInAProcessOfItsOwn) {
  options_.jobs = 2;
  const auto runs = run({1, 2, 3});
  ASSERT_EQ(runs.size(), 3u);
  for (const SetRun& run : runs) {
    EXPECT_EQ(run.error, "");
    EXPECT_FALSE(run.kept);
    const double expected = 0.01 * static_cast<double>(run.seed) * std::sqrt(200.0 / 201);
    EXPECT_NEAR(run.result.value().value("/ate_origin_rmse_m").value(), expected, 1e-9);  // m
  }
  EXPECT_THAT(progress_, HasSubstr("[3/3] fake, seed "));
  EXPECT_THAT(read_file(folder_ / "fake/seed-2/log.txt"), HasSubstr("100%"));
}

TEST_F(RunSetTest, WhatIsThereIsKeptUnlessItsInputsDiffer) {
  run({1});
  const auto again = run({1, 2});
  EXPECT_TRUE(again[0].kept);
  EXPECT_FALSE(again[1].kept);
  EXPECT_EQ(again[0].result.value().value("/frames").value(), 201);
  EXPECT_THAT(progress_, HasSubstr("seed 1: passed (kept)"));

  options_.force = true;
  EXPECT_FALSE(run({1})[0].kept);
  options_.force = false;
  scenario_.slam.tracking.radius += 1;
  EXPECT_FALSE(run({1})[0].kept);
  EXPECT_TRUE(run({1})[0].kept);
  folder_.write("fake/seed-1/metrics.json", "{\"frames\": 2");  // half a file
  EXPECT_FALSE(run({1})[0].kept);
}

// Its hash, and the last digits of its results, may be others.
TEST_F(RunSetTest, WhatAnotherEnvironmentMadeRunsAgain) {
  repeats_ = 2;
  options_.run = [this](const ScenarioConfig& scenario, int threads, const RunOptions& options) {
    RunOptions with_libraries = options;
    with_libraries.libraries = options_.libraries(scenario);
    return test::run_fake(scenario, threads, with_libraries);
  };
  const auto draws = [&](const char* renderer) {
    options_.libraries = [renderer](const ScenarioConfig&) {
      return NamedValues{{"renderer", renderer}};
    };
  };
  draws("llvmpipe");
  run({1});
  EXPECT_TRUE(run({1})[1].kept);
  draws("a GPU");
  repeats_ = 1;
  const SetRun again = run({1}).at(0);
  EXPECT_FALSE(again.kept);
  EXPECT_EQ(again.result.value().json["hash_environment"]["renderer"], "a GPU");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "fake/seed-1/repeat-2/metrics.json"));
  EXPECT_TRUE(run({1})[0].kept);
}

// A program before it had the environment, or a file that was edited.
TEST_F(RunSetTest, WhatHasNoEnvironmentRunsAgain) {
  run({1});
  Json metrics = read_stored_run(folder_ / "fake/seed-1/metrics.json").value().json;
  metrics.erase("hash_environment");
  folder_.write("fake/seed-1/metrics.json", metrics.dump());
  EXPECT_FALSE(run({1})[0].kept);
}

TEST_F(RunSetTest, ARunThatCrashesIsAnErrorOfItsOwn) {
  options_.run = [](const ScenarioConfig& scenario, int threads, const RunOptions& options) {
    if (scenario.seed == 2) raise(SIGKILL);
    return test::run_fake(scenario, threads, options);
  };
  const auto runs = run({1, 2, 3});
  EXPECT_FALSE(outcome_.interrupted);
  EXPECT_EQ(runs[1].error, "fake, seed 2: the process ended by signal 9");
  EXPECT_EQ(runs[2].error, "");
}

TEST_F(RunSetTest, AFolderInUseIsAnErrorOfItsRun) {
  const FolderLock other(folder_ / "fake/seed-2");
  const auto runs = run({1, 2});
  EXPECT_EQ(runs[0].error, "");
  EXPECT_THAT(runs[1].error, HasSubstr("another process is writing there"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "fake/seed-2"));
}

TEST_F(RunSetTest, LinksInTheFoldersAreNotFollowed) {
  const auto target = folder_.write("target", "theirs");
  std::filesystem::create_directories(folder_ / "fake/seed-1");
  std::filesystem::create_directories(folder_ / "theirs");
  for (const char* name : {"log.txt", "inputs.txt", "inputs.txt.partial"}) {
    std::filesystem::create_symlink(target, folder_ / "fake/seed-1" / name);
  }
  std::filesystem::create_directory_symlink(folder_ / "theirs", folder_ / "fake/seed-2");
  const auto runs = run({1, 2});
  EXPECT_EQ(runs[0].error, "");
  EXPECT_EQ(read_file(target), "theirs");
  EXPECT_THAT(read_file(folder_ / "fake/seed-1/log.txt"), HasSubstr("100%"));
  EXPECT_THAT(runs[1].error, HasSubstr("seed-2: is a link"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "theirs"));
}

TEST_F(RunSetTest, AStopLeavesTheRestForAnotherTime) {
  options_.stopped = [&] { return std::filesystem::exists(folder_ / "fake/seed-1/inputs.txt"); };
  options_.run = [](const ScenarioConfig& scenario, int threads, const RunOptions& options) {
    RunOptions undisturbed = options;
    undisturbed.stopped = {};
    return test::run_fake(scenario, threads, undisturbed);
  };
  run({1, 2, 3});
  EXPECT_TRUE(outcome_.interrupted);
  options_.stopped = {};
  const auto again = run({1, 2, 3});
  EXPECT_FALSE(outcome_.interrupted);
  EXPECT_TRUE(again[0].kept);
  EXPECT_FALSE(again[2].kept);
}

}  // namespace
}  // namespace vinebench::harness
