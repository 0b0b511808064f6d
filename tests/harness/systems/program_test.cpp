// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/systems/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ProgramTest : public testing::Test {
 protected:
  Program shell(const std::string& script) const {
    return {.file = "/bin/sh",
            .arguments = {"-c", script},
            .environment = {{"VINEBENCH_WORD", "given"}},
            .folder = folder_.path(),
            .log = folder_ / "log.txt",
            .stopped = {}};
  }
  std::string log() const { return read_file(folder_ / "log.txt"); }

  test::TestFolder folder_;
};

TEST_F(ProgramTest, RunsInItsFolderWithItsEnvironmentAndLog) {
  EXPECT_TRUE(run_program(shell("pwd -P >place; echo $VINEBENCH_WORD; echo aside >&2")));
  EXPECT_EQ(read_file(folder_ / "place"),
            std::filesystem::canonical(folder_.path()).string() + "\n");
  EXPECT_EQ(log(), "given\naside\n");
}

TEST_F(ProgramTest, ALinkInTheLogsPlaceIsReplaced) {
  const auto target = folder_.write("target", "theirs");
  std::filesystem::create_symlink(target, folder_ / "log.txt");
  EXPECT_TRUE(run_program(shell("echo ours")));
  EXPECT_EQ(log(), "ours\n");
  EXPECT_EQ(read_file(target), "theirs");
}

TEST_F(ProgramTest, AnExitCodeIsAnErrorWithTheLastLine) {
  const std::string error =
      test::error_of([&] { run_program(shell("echo first; echo the reason; echo; exit 3")); });
  EXPECT_THAT(error, AllOf(HasSubstr("exit code 3"), HasSubstr("the reason")));
  EXPECT_THAT(test::error_of([&] { run_program(shell("exit 1")); }),
              HasSubstr("it printed nothing"));
}

TEST_F(ProgramTest, ASignalIsNamed) {
  EXPECT_THAT(test::error_of([&] { run_program(shell("kill -TERM $$")); }),
              HasSubstr("ended by signal 15 (Terminated)"));
}

TEST_F(ProgramTest, AMissingProgramIsNamed) {
  Program program = shell("");
  program.file = folder_ / "none";
  EXPECT_THAT(test::error_of([&] { run_program(program); }),
              AllOf(HasSubstr("none"), HasSubstr("cannot be started")));
}

TEST_F(ProgramTest, TheTimeoutEndsIt) {
  Program program = shell("sleep 60");
  program.timeout = 0.05;  // s
  EXPECT_THAT(test::error_of([&] { run_program(program); }), HasSubstr("took more than 0.05 s"));
}

TEST_F(ProgramTest, TooMuchMemoryEndsIt) {
  Program program = shell("echo begun; head -c 300M /dev/zero | tail -c 300M | sleep 60");
  program.memory_mib = 100;
  EXPECT_THAT(test::error_of([&] { run_program(program); }),
              AllOf(HasSubstr("used more than 100 MiB of memory"), HasSubstr("begun")));
}

TEST_F(ProgramTest, AStopEndsItWithItsChildren) {
  Program program = shell("(sleep 1; echo late) & wait");
  program.stopped = [] { return true; };
  EXPECT_FALSE(run_program(program));
  EXPECT_EQ(log(), "");
}

}  // namespace
}  // namespace vinebench::harness
