// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/run/run_cost.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>
#include <filesystem>

namespace vinebench::harness {
namespace {

TEST(StageTimingsTest, AreOfTheStagesThatWereCalled) {
  StageTimes times;
  for (const double ms : {1.0, 2.0, 6.0}) times.add("stereo", ms);
  times.add("frame", 4);
  const std::vector<StageTiming> timings = stage_timings(times);
  ASSERT_EQ(timings.size(), 2u);
  EXPECT_EQ(timings[0].stage, "frame");
  EXPECT_EQ(timings[1].stage, "stereo");
  EXPECT_DOUBLE_EQ(timings[1].mean, 3);
  EXPECT_DOUBLE_EQ(timings[1].median, 2);
  EXPECT_DOUBLE_EQ(timings[1].p95, 2 + 0.9 * 4);  // place 0.95 * 2 = 1.9
}

double seconds_of_children() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

/// Run by the test below in a process of its own.
TEST(CpuSecondsTest, DISABLED_OfAProgramThatAShellBecame) {
  ASSERT_GT(seconds_of_children(), 0.05);  // of the shell's child
  EXPECT_LT(cpu_seconds(), seconds_of_children() / 2);
}

TEST(CpuSecondsTest, LeaveOutWhatRanBeforeTheProgram) {
  // A shell's child counts to 300000, some tenths of a second; then the shell becomes this program.
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::string command =
      "bash -c '(for ((i = 0; i < 300000; i++)); do :; done); exec \"$0\" "
      "--gtest_also_run_disabled_tests "
      "--gtest_filter=CpuSecondsTest.DISABLED_OfAProgramThatAShellBecame' '" +
      program + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST(CpuSecondsTest, GrowWithWork) {
  const double before = cpu_seconds();
  volatile double sum = 0;
  while (cpu_seconds() < before + 0.02) sum = sum + 1;
  EXPECT_GE(cpu_seconds(), before + 0.02);
}

}  // namespace
}  // namespace vinebench::harness
