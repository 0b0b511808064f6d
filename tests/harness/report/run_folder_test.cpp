// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/report/run_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/util/error.h"
#include "core/util/files.h"
#include "tests/support/fakes.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(RunFolderTest, WhatAnEarlierRunLeftIsRemoved) {
  const test::TestFolder tests;
  const fs::path folder = tests / "a/run";
  prepare_run_folder(folder, "settings.yaml", "old: 1\n");
  const std::vector<std::string> stale{"metrics.json", kInputsFile, "frames/000200_side.png",
                                       "frames/1000000_front_left.png"};
  const std::vector<std::string> foreign{"notes.txt", "frames/my.png", "frames/12_side.png"};
  for (const auto& names : {stale, foreign}) {
    for (const std::string& name : names) write_file_atomically(folder / name, "x");
  }
  prepare_run_folder(folder, "settings.yaml", "new: 1\n");
  for (const std::string& name : stale) EXPECT_FALSE(fs::exists(folder / name)) << name;
  for (const std::string& name : foreign) EXPECT_TRUE(fs::exists(folder / name)) << name;
  EXPECT_EQ(read_file(folder / "settings.yaml"), "new: 1\n");
}

TEST(RunFolderTest, AFolderThatCannotBeWrittenIsAnError) {
  const test::TestFolder tests;
  const fs::path file = tests.write("file", "not a folder");
  EXPECT_THAT(test::error_of([&] { prepare_run_folder(file / "run", "settings.yaml", ""); }),
              testing::AllOf(HasSubstr("output folder"), HasSubstr("Not a directory")));
  fs::create_directories(tests / "run/settings.yaml");  // in place of the file
  EXPECT_THAT(test::error_of([&] { prepare_run_folder(tests / "run", "settings.yaml", ""); }),
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
