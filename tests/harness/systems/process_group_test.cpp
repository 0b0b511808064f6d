// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/systems/process_group.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <optional>
#include <thread>

#include "tests/support/processes.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::MatchesRegex;

constexpr std::chrono::seconds kLong{20};

class ProcessGroupTest : public testing::Test {
 protected:
  ProcessStart shell(const std::string& script) const {
    return {.file = "/bin/sh",
            .arguments = {"-c", script},
            .environment = {{"VINEBENCH_WORD", "given"}},
            .folder = folder_.path(),
            .log = folder_ / "log.txt"};
  }
  std::string how_it_ends(const std::string& script) const {
    ProcessGroup process(shell(script));
    EXPECT_TRUE(process.wait(kLong));
    return process.how_it_ended();
  }
  std::string refusal(const fs::path& file) const {
    return test::error_of([&] { check_executable(file); });
  }
  fs::path script(const char* name, const std::string& text) const {
    const fs::path file = folder_.write(name, text);
    fs::permissions(file, fs::perms::owner_all);
    return file;
  }

  test::TestFolder folder_;
};

TEST_F(ProcessGroupTest, SaysHowAProcessEnded) {
  EXPECT_EQ(how_it_ends("exit 0"), "exit code 0");
  EXPECT_EQ(how_it_ends("exit 7"), "exit code 7");
  EXPECT_EQ(how_it_ends("kill -SEGV $$"), "ended by signal 11 (Segmentation fault)");
}

TEST_F(ProcessGroupTest, OnlyExitCode0IsASuccess) {
  for (const auto& [text, success] :
       {std::pair("exit 0", true), std::pair("exit 1", false), std::pair("kill -TERM $$", false)}) {
    ProcessGroup process(shell(text));
    EXPECT_TRUE(process.wait(kLong));
    EXPECT_EQ(process.succeeded(), success) << text;
  }
}

TEST_F(ProcessGroupTest, AWaitHasAnEnd) {
  ProcessGroup process(shell("sleep 60"));
  EXPECT_FALSE(process.wait(std::chrono::milliseconds(20)));
  EXPECT_FALSE(process.has_ended());
}

// The descriptor is a file with a word in it; the next number is not open.
TEST_F(ProcessGroupTest, GivesItsDescriptorsAndNoOthers) {
  const int file = open(folder_.write("word", "shared\n").c_str(), O_RDONLY);
  const int other = open(folder_.path().c_str(), O_RDONLY | O_DIRECTORY);
  ProcessStart start = shell("cat <&3; ls /proc/$$/fd; echo $VINEBENCH_WORD");
  start.descriptors = {file};
  ProcessGroup process(start);
  EXPECT_TRUE(process.wait(kLong));
  EXPECT_EQ(read_file(folder_ / "log.txt"), "shared\n0\n1\n2\n3\ngiven\n");
  close(file);
  close(other);
}

// 200 MiB in a grandchild: a string of 0s that the shell's program holds.
TEST_F(ProcessGroupTest, CountsTheMemoryOfAllItsProcesses) {
  ProcessGroup process(shell("(head -c 200M /dev/zero | tail -c 200M | sleep 60) & sleep 60"));
  const auto grows = [&] {
    for (int i = 0; i < 100; ++i) {
      if (process.exceeds_memory(150)) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(110));  // it looks every 100 ms
    }
    return false;
  };
  EXPECT_TRUE(grows());
  std::this_thread::sleep_for(std::chrono::milliseconds(110));
  EXPECT_FALSE(process.exceeds_memory(4000));
}

TEST_F(ProcessGroupTest, WhatItStartedEndsWithIt) {
  {
    ProcessGroup process(shell("(sleep 0.5; : >late) & : >started"));
    EXPECT_TRUE(process.wait(kLong));
  }
  EXPECT_TRUE(fs::exists(folder_ / "started"));
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  EXPECT_FALSE(fs::exists(folder_ / "late"));
}

// Nobody tells the group: its watcher sees that the bench is gone. The second process is one that
// the program has started; a third one ignores what may be ignored.
TEST_F(ProcessGroupTest, NothingIsLeftWhenTheBenchIsKilled) {
  const std::vector<pid_t> left = test::kill_when_listed(folder_ / "pids", 3, [&] {
    ProcessGroup process(
        shell("sleep 60 & echo $$ $! >pids; (trap '' HUP INT TERM; sh -c 'echo $PPID >>pids'; "
              "while :; do sleep 60; done)"));
    process.wait(std::chrono::seconds(60));
  });
  EXPECT_EQ(left.size(), 3u);
  EXPECT_TRUE(test::end_soon(left));
}

TEST_F(ProcessGroupTest, AProgramThatSignalsItsGroupIsWatchedStill) {
  const std::vector<pid_t> left = test::kill_when_listed(folder_ / "pids", 1, [&] {
    ProcessGroup process(shell("trap '' TERM; kill -TERM 0; echo $$ >pids; sleep 60"));
    process.wait(std::chrono::seconds(60));
  });
  EXPECT_EQ(left.size(), 1u);
  EXPECT_TRUE(test::end_soon(left));
}

// The thread that started a process may end before it.
TEST_F(ProcessGroupTest, OutlivesTheThreadThatStartedIt) {
  std::optional<ProcessGroup> process;
  std::thread([&] { process.emplace(shell("sleep 60")); }).join();
  EXPECT_FALSE(process->wait(std::chrono::milliseconds(100)));
}

TEST_F(ProcessGroupTest, ProgramsAndScriptsAreExecutable) {
  EXPECT_EQ(refusal("/bin/sh"), "");
  EXPECT_EQ(refusal(script("a.sh", "#!/bin/sh -e\n")), "");
  EXPECT_EQ(refusal(script("b.sh", "#! " + (folder_ / "a.sh").string() + "\n")), "");
}

TEST_F(ProcessGroupTest, WhatCannotBeExecutedIsNamed) {
  EXPECT_THAT(refusal(folder_ / "none"), HasSubstr("none: cannot be started: no such file"));
  EXPECT_THAT(refusal(folder_.path()), HasSubstr("cannot be started: is no file"));
  EXPECT_THAT(refusal(folder_.write("readme.txt", "#!/bin/sh\n")),
              HasSubstr("readme.txt: cannot be started: Permission denied"));
  EXPECT_THAT(refusal(script("text", "no program")), HasSubstr("expected a program, or a script"));
  EXPECT_THAT(refusal(script("empty", "")), HasSubstr("expected a program, or a script"));
  EXPECT_THAT(refusal(script("c.sh", "#!/no/such/shell\n")),
              MatchesRegex(".*c.sh: its interpreter /no/such/shell: cannot be started: no such "
                           "file"));
}

}  // namespace
}  // namespace vinebench::harness
