// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/files/output_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cerrno>
#include <set>
#include <thread>
#include <vector>

#include "tests/support/test_folder.h"

namespace vinebench {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class OutputFileTest : public testing::Test {
 protected:
  std::set<std::string> content() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
      names.insert(entry.path().filename().string());
    }
    return names;
  }

  test::TestFolder folder_;
};

/// The mode that the umask leaves of read and write for all.
mode_t usual_mode() {
  const mode_t mask = umask(0);
  umask(mask);
  return 0666 & ~mask;
}

mode_t mode_of(const fs::path& file) {
  struct stat status {};
  EXPECT_EQ(stat(file.c_str(), &status), 0);
  return status.st_mode & 0777;
}

TEST_F(OutputFileTest, PartsOfAnySizeFollowEachOther) {
  const std::string large(200'000, 'x');  // more than waits for one call
  OutputFile out(folder_ / "x");
  out.write("first ");
  out.write(large);
  out.write(" last");
  EXPECT_FALSE(fs::exists(folder_ / "x"));
  out.finish();
  EXPECT_EQ(read_file(folder_ / "x"), "first " + large + " last");
  EXPECT_EQ(content(), std::set<std::string>{"x"});
  EXPECT_EQ(mode_of(folder_ / "x"), usual_mode());
}

TEST_F(OutputFileTest, AnUnfinishedFileIsRemovedAndTheOldOneStays) {
  folder_.write("x", "old");
  {
    OutputFile out(folder_ / "x");
    out.write("new");
    EXPECT_EQ(content().size(), 2u);
  }
  EXPECT_EQ(content(), std::set<std::string>{"x"});
  EXPECT_EQ(read_file(folder_ / "x"), "old");
}

TEST_F(OutputFileTest, ALinkIsReplacedAndItsTargetStays) {
  const fs::path target = folder_.write("target", "theirs");
  fs::create_symlink(target, folder_ / "x");
  OutputFile out(folder_ / "x");
  out.write("ours");
  out.finish();
  EXPECT_EQ(read_file(target), "theirs");
  EXPECT_FALSE(fs::is_symlink(folder_ / "x"));
  EXPECT_EQ(read_file(folder_ / "x"), "ours");
}

TEST_F(OutputFileTest, TemporaryNamesAreNotToBeForeseen) {
  const fs::path target = folder_.write("target", "theirs");
  fs::create_symlink(target, folder_ / "x.partial");
  OutputFile first(folder_ / "x");
  OutputFile second(folder_ / "x");
  EXPECT_EQ(content().size(), 4u);
  first.finish();
  second.finish();
  EXPECT_EQ(content(), (std::set<std::string>{"target", "x", "x.partial"}));
  EXPECT_TRUE(fs::is_symlink(folder_ / "x.partial"));
  EXPECT_EQ(read_file(target), "theirs");
}

TEST_F(OutputFileTest, SeveralThreadsMayWriteOneFile) {
  const std::string bytes(100'000, 'x');
  std::vector<std::thread> threads;
  for (int i = 0; i < 6; ++i) {
    threads.emplace_back([&] {
      for (int k = 0; k < 50; ++k) {
        OutputFile out(folder_ / "x");
        out.write(bytes);
        EXPECT_NO_THROW(out.finish());
        EXPECT_EQ(read_file(folder_ / "x"), bytes);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(content(), std::set<std::string>{"x"});
}

TEST_F(OutputFileTest, ACreatedFileReplacesALinkAndAFile) {
  const fs::path target = folder_.write("target", "theirs");
  fs::create_symlink(target, folder_ / "link");
  fs::create_symlink(folder_ / "nowhere", folder_ / "dangling");
  fs::create_hard_link(target, folder_ / "hard");
  for (const char* name : {"link", "dangling", "hard", "new"}) {
    EXPECT_EQ(write_bytes(create_file(folder_ / name), "ours"), 0);
    EXPECT_EQ(read_file(folder_ / name), "ours") << name;
    EXPECT_FALSE(fs::is_symlink(folder_ / name)) << name;
    EXPECT_EQ(mode_of(folder_ / name), usual_mode()) << name;
  }
  EXPECT_EQ(read_file(target), "theirs");
  EXPECT_FALSE(fs::exists(folder_ / "nowhere"));
}

TEST_F(OutputFileTest, ALinkedFileHasTwoNamesAndReplacesWhatHadTheSecond) {
  const fs::path file = folder_.write("file", "ours");
  const fs::path target = folder_.write("target", "theirs");
  fs::create_symlink(target, folder_ / "link");
  folder_.write("old", "before");
  for (const char* name : {"new", "old", "link", "new"}) {  // the last is one of its names already
    EXPECT_TRUE(link_file(file, folder_ / name));
    EXPECT_EQ(read_file(folder_ / name), "ours") << name;
    EXPECT_FALSE(fs::is_symlink(folder_ / name)) << name;
  }
  EXPECT_EQ(fs::hard_link_count(file), 4u);
  EXPECT_EQ(read_file(target), "theirs");
  EXPECT_EQ(content(), (std::set<std::string>{"file", "target", "new", "old", "link"}));
}

// A new file takes the name: what was linked to it keeps its bytes.
TEST_F(OutputFileTest, WritingALinkedFileAgainLeavesItsOtherName) {
  const fs::path file = folder_.write("file", "first");
  ASSERT_TRUE(link_file(file, folder_ / "other"));
  write_file_atomically(file, "second");
  EXPECT_EQ(read_file(file), "second");
  EXPECT_EQ(read_file(folder_ / "other"), "first");
}

TEST_F(OutputFileTest, ALinkThatCannotHaveItsNameIsAnError) {
  const fs::path file = folder_.write("file", "ours");
  fs::create_directory(folder_ / "folder");
  EXPECT_THAT(test::error_of([&] { link_file(file, folder_ / "folder"); }),
              AllOf(HasSubstr((folder_ / "folder").string()), HasSubstr("Is a directory")));
  EXPECT_EQ(content(), (std::set<std::string>{"file", "folder"}));
}

TEST_F(OutputFileTest, WhereNoLinkCanBeMadeNothingIsDone) {
  const fs::path file = folder_.write("file", "ours");
  EXPECT_FALSE(link_file(folder_ / "missing", folder_ / "x"));
  EXPECT_FALSE(link_file(file, folder_ / "no/x"));
  EXPECT_FALSE(link_file("/proc/self/status", folder_ / "x"));  // another file system
  EXPECT_EQ(content(), (std::set<std::string>{"file"}));
}

TEST_F(OutputFileTest, WhatCannotBeCreatedIsNamedWithItsReason) {
  EXPECT_THAT(test::error_of([&] { create_file(folder_.path()); }),
              AllOf(HasSubstr(folder_.path().string()), HasSubstr("Is a directory")));
  EXPECT_THAT(test::error_of([&] { create_file(folder_ / "no/x"); }),
              HasSubstr("no/x: cannot be written: No such file or directory"));
  EXPECT_THAT(test::error_of([&] { OutputFile(folder_ / "no/x"); }),
              HasSubstr("no/x: cannot be written: No such file or directory"));
}

// /dev/full takes nothing, for root neither.
TEST_F(OutputFileTest, AFullDiskIsReported) {
  EXPECT_EQ(write_bytes(Descriptor(open("/dev/full", O_WRONLY)), "x"), ENOSPC);
}

}  // namespace
}  // namespace vinebench
