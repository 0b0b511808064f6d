// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/report/run_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "core/files/files.h"
#include "core/util/error.h"
#include "harness/run.h"
#include "tests/support/fakes.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(RunFolderTest, WhatAnEarlierRunLeftIsRemoved) {
  const test::TestFolder tests;
  const fs::path folder = tests / "a/run";
  { const FolderLock lock = prepare_run_folder(folder, "settings.yaml", "old: 1\n"); }
  const std::vector<std::string> stale{"metrics.json",
                                       kInputsFile,
                                       "frames/000200_side.png",
                                       "frames/1000000_front_left.png",
                                       "plot.svg.0123456789abcdef.partial",
                                       "frames/000200_side.png.0123456789abcdef.partial"};
  const std::vector<std::string> foreign{"notes.txt", "frames/my.png", "frames/12_side.png",
                                         "x.partial"};
  for (const auto& names : {stale, foreign}) {
    for (const std::string& name : names) write_file_atomically(folder / name, "x");
  }
  const FolderLock lock = prepare_run_folder(folder, "settings.yaml", "new: 1\n");
  for (const std::string& name : stale) EXPECT_FALSE(fs::exists(folder / name)) << name;
  for (const std::string& name : foreign) EXPECT_TRUE(fs::exists(folder / name)) << name;
  EXPECT_EQ(read_file(folder / "settings.yaml"), "new: 1\n");
}

TEST(RunFolderTest, AFolderThatCannotBeWrittenIsAnError) {
  const test::TestFolder tests;
  const fs::path file = tests.write("file", "not a folder");
  EXPECT_THAT(
      test::error_of([&] { std::ignore = prepare_run_folder(file / "run", "settings.yaml", ""); }),
      testing::AllOf(HasSubstr("output folder"), HasSubstr("Not a directory")));
  fs::create_directories(tests / "run/settings.yaml");  // in place of the file
  EXPECT_THAT(
      test::error_of([&] { std::ignore = prepare_run_folder(tests / "run", "settings.yaml", ""); }),
      HasSubstr("output folder"));
}

TEST(RunFolderTest, HasTheFilesOfTheRun) {
  const test::TestFolder folder;
  const RunRecord record = test::record_of();
  const RunReport report = judge(record, test::fake_trial());
  write_run_files(folder.path(), test::fake_trial(), record, report);
  EXPECT_EQ(read_tum(folder / "groundtruth.tum").size(), 201u);
  EXPECT_EQ(read_tum(folder / "estimate_live.tum").size(), 201u);
  EXPECT_EQ(read_tum(folder / "estimate.tum").size(), 201u);
  EXPECT_EQ(read_tum(folder / "keyframes.tum").size(), 5u);  // frames 0, 50, 100, 150, 200
  EXPECT_THAT(read_file(folder / "summary.txt"), HasSubstr("no degraded segment"));
  EXPECT_THAT(read_file(folder / "plot.svg"), testing::StartsWith("<svg"));
  EXPECT_FALSE(fs::exists(folder / "metrics.json"));
  write_metrics(folder.path(), report);
  EXPECT_THAT(read_file(folder / "metrics.json"),
              testing::StartsWith("{\n  \"scenario\": \"fake\",\n"));
}

TEST(RunFolderTest, AFolderInUseIsAnErrorAndUnchanged) {
  const test::TestFolder folder;
  const FolderLock first = prepare_run_folder(folder.path(), "settings.yaml", "first: 1\n");
  folder.write("metrics.json", "{}");
  EXPECT_THAT(test::error_of([&] {
                std::ignore = prepare_run_folder(folder.path(), "settings.yaml", "second: 1\n");
              }),
              testing::AllOf(HasSubstr("output folder " + folder.path().string()),
                             HasSubstr("another process is writing there")));
  EXPECT_EQ(read_file(folder / "settings.yaml"), "first: 1\n");
  EXPECT_TRUE(fs::exists(folder / "metrics.json"));
}

/// Files and images of a run of the fakes.
void run_fakes(const fs::path& folder) {
  const FolderLock lock = prepare_run_folder(folder, "settings.yaml", test::kFakeSettings);
  test::FakeSource source;
  test::FakeSlam slam;
  RunOptions options;
  options.folder = folder;
  run_lockstep_and_judge(test::fake_trial(), source, slam, options);
}

std::set<std::string> files_of(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_directory()) names.insert(entry.path().lexically_relative(folder).string());
  }
  return names;
}

// The names are those that a first run writes; beside each, that of a temporary file before its
// name was random.
TEST(RunFolderTest, LinksInTheFolderAreNotFollowed) {
  const test::TestFolder tests;
  run_fakes(tests / "first");
  const std::set<std::string> names = files_of(tests / "first");
  EXPECT_GE(names.size(), 9u);
  const fs::path target = tests.write("target", "theirs");
  fs::create_directories(tests / "second/frames");
  for (const std::string& name : names) {
    fs::create_symlink(target, tests / "second" / name);
    fs::create_symlink(target, tests / "second" / (name + ".partial"));
  }
  run_fakes(tests / "second");
  EXPECT_EQ(read_file(target), "theirs");
  for (const std::string& name : names) {
    EXPECT_FALSE(fs::is_symlink(tests / "second" / name)) << name;
    EXPECT_TRUE(fs::is_symlink(tests / "second" / (name + ".partial"))) << name;
  }
}

TEST(RunFolderTest, ALinkInTheImagesPlaceIsAnErrorAndNothingIsRemovedBehindIt) {
  const test::TestFolder tests;
  fs::create_directories(tests / "theirs");
  fs::create_directories(tests / "run");
  tests.write("theirs/000000_front_left.png", "x");
  fs::create_directory_symlink(tests / "theirs", tests / "run/frames");
  EXPECT_THAT(
      test::error_of([&] { std::ignore = prepare_run_folder(tests / "run", "s.yaml", ""); }),
      HasSubstr("run/frames: is a link"));
  EXPECT_TRUE(fs::exists(tests / "theirs/000000_front_left.png"));
}

// Each line of estimate.tum has its status on the same line of the companion, after the header.
TEST(RunFolderTest, DeadReckonedPosesAreToldFromTrackedOnes) {
  const test::TestFolder folder;
  RunRecord record = test::record_of();
  record.ticks[3].estimate.status = TrackingStatus::kDeadReckoning;
  record.summary.trajectory = {record.summary.trajectory[2], record.summary.trajectory[3]};
  record.summary.trajectory.push_back({stamp_of_frame(9, test::kFakeRate) + 1, {}});
  write_run_files(folder.path(), test::fake_trial(), record, judge(record, test::fake_trial()));
  EXPECT_EQ(read_file(folder / "estimate_status.csv"),
            "#timestamp [s],status\n0.200000000,tracked\n0.300000000,dead_reckoning\n"
            "0.900000001,unknown\n");
}

// Cartons cover 95 % of the front pair; the events' threshold is that of the expectation.
TEST(RunFolderTest, EventsUseTheShareOfTheExpectation) {
  const test::TestFolder folder;
  const RunRecord record = test::record_of();
  Trial trial = test::fake_trial();
  write_run_files(folder.path(), trial, record, judge(record, trial));
  EXPECT_THAT(read_file(folder / "events.jsonl"), HasSubstr("occlusion_begin"));
  trial.expectations.blind = {.cameras = {"front_left"}, .box_share = 0.97, .inliers_drop = {}};
  write_run_files(folder.path(), trial, record, judge(record, trial));
  EXPECT_THAT(read_file(folder / "events.jsonl"), testing::Not(HasSubstr("occlusion_begin")));
}

}  // namespace
}  // namespace vinebench::harness
