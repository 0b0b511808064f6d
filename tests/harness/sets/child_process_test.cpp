// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sets/child_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <map>

#include "core/util/error.h"
#include "tests/support/processes.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

std::map<std::size_t, ChildOutcome> run_all(ChildJobs jobs) {
  std::map<std::size_t, ChildOutcome> outcomes;
  jobs.name = [](std::size_t i) { return "job " + std::to_string(i); };
  jobs.done = [&](std::size_t i, const ChildOutcome& outcome) { outcomes[i] = outcome; };
  run_in_children(jobs);
  return outcomes;
}

TEST(RunInChildTest, ReturnsTheTextAndLeavesThisProcessAlone) {
  int here = 1;
  const std::string text(100'000, 'x');  // more than a pipe's buffer
  EXPECT_EQ(run_in_child("a job",
                         [&] {
                           here = 2;
                           return text;
                         }),
            text);
  EXPECT_EQ(here, 1);
}

TEST(RunInChildTest, ReportsWhatWentWrong) {
  EXPECT_EQ(
      test::error_of([] { run_in_child("a job", []() -> std::string { fail("no such file"); }); }),
      "no such file");
  EXPECT_EQ(test::error_of([] { run_in_child("a job", []() -> std::string { std::_Exit(7); }); }),
            "a job: exit code 7");
}

TEST(RunInChildrenTest, OneThatFailsTakesNoOtherAlong) {
  const auto outcomes = run_all({.count = 4, .at_once = 2, .job = [](std::size_t i) -> std::string {
                                   if (i == 1) raise(SIGKILL);
                                   if (i == 2) fail("disk full");
                                   return "text " + std::to_string(i);
                                 }});
  ASSERT_EQ(outcomes.size(), 4u);
  EXPECT_TRUE(outcomes.at(0).ok);
  EXPECT_EQ(outcomes.at(0).text, "text 0");
  EXPECT_FALSE(outcomes.at(1).ok);
  EXPECT_EQ(outcomes.at(1).text, "job 1: the process ended by signal 9");
  EXPECT_FALSE(outcomes.at(2).ok);
  EXPECT_EQ(outcomes.at(2).text, "disk full");
  EXPECT_EQ(outcomes.at(3).text, "text 3");
}

// Each job waits for the other one's file: they end only if they run concurrently.
TEST(RunInChildrenTest, RunsThemSideBySide) {
  const test::TestFolder folder;
  const auto outcomes = run_all({.count = 2, .at_once = 2, .job = [&](std::size_t i) {
                                   folder.write(std::to_string(i), "");
                                   const auto other = folder / std::to_string(1 - i);
                                   for (int n = 0; n < 5000; ++n) {  // 5 s
                                     if (std::filesystem::exists(other)) return "met";
                                     usleep(1000);
                                   }
                                   return "alone";
                                 }});
  EXPECT_EQ(outcomes.at(0).text, "met");
  EXPECT_EQ(outcomes.at(1).text, "met");
}

TEST(RunInChildrenTest, AStopEndsTheRunningAndStartsNoFurther) {
  const test::TestFolder folder;
  const auto started = [&] { return std::filesystem::exists(folder / "0"); };
  const auto outcomes = run_all({.count = 3,
                                 .at_once = 1,
                                 .job =
                                     [&](std::size_t i) {
                                       folder.write(std::to_string(i), "");
                                       sleep(60);
                                       return "";
                                     },
                                 .stopped = started});
  ASSERT_EQ(outcomes.size(), 1u);
  EXPECT_EQ(outcomes.at(0).text, "job 0: the process ended by signal 15");
}

// A child that ignores SIGTERM, as one does that hangs.
TEST(RunInChildrenTest, NoChildIsLeftWhenTheParentIsKilled) {
  const test::TestFolder folder;
  const std::vector<pid_t> left = test::kill_when_listed(folder / "pid", 1, [&] {
    run_all({.count = 1, .at_once = 1, .job = [&](std::size_t) {
               signal(SIGTERM, SIG_IGN);
               folder.write("pid", std::to_string(getpid()) + "\n");
               sleep(60);
               return "";
             }});
  });
  EXPECT_EQ(left.size(), 1u);
  EXPECT_TRUE(test::end_soon(left));
}

TEST(RunInChildTest, ItIsNotLeftWhenTheParentIsKilled) {
  const test::TestFolder folder;
  const std::vector<pid_t> left = test::kill_when_listed(folder / "pid", 1, [&] {
    run_in_child("a job", [&] {
      folder.write("pid", std::to_string(getpid()) + "\n");
      sleep(60);
      return "";
    });
  });
  EXPECT_EQ(left.size(), 1u);
  EXPECT_TRUE(test::end_soon(left));
}

}  // namespace
}  // namespace vinebench::harness
