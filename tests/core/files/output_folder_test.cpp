// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/files/output_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <array>
#include <optional>

#include "tests/support/test_folder.h"

namespace vinebench {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(OutputFolderTest, ALockedFolderIsForOneAlone) {
  const test::TestFolder tests;
  const fs::path folder = tests / "a/b";
  std::optional<FolderLock> first(folder);
  EXPECT_TRUE(fs::is_directory(folder));
  EXPECT_TRUE(fs::is_empty(folder));  // no file is needed for it
  EXPECT_THAT(test::error_of([&] { FolderLock second(folder); }),
              AllOf(HasSubstr(folder.string()), HasSubstr("another process is writing there")));
  const FolderLock other(tests / "a/c");
  const FolderLock moved = *std::move(first);
  first.reset();
  EXPECT_NE(test::error_of([&] { FolderLock second(folder); }), "");
}

TEST(OutputFolderTest, TheLockEndsWithItsObject) {
  const test::TestFolder tests;
  { const FolderLock first(tests.path()); }
  EXPECT_EQ(test::error_of([&] { FolderLock second(tests.path()); }), "");
}

/// A process that locks the folder and waits for its end.
class LockingProcess {
 public:
  explicit LockingProcess(const fs::path& folder) {
    std::array<int, 2> ends{};
    EXPECT_EQ(pipe(ends.data()), 0);
    process_ = fork();
    if (process_ == 0) {
      const FolderLock lock(folder);
      if (write(ends[1], "x", 1) != 1) _exit(1);
      for (;;) pause();
    }
    char locked = 0;
    EXPECT_EQ(read(ends[0], &locked, 1), 1);
    close(ends[0]);
    close(ends[1]);
  }
  ~LockingProcess() { kill_it(); }
  void kill_it() {
    if (process_ <= 0) return;
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
    process_ = 0;
  }

 private:
  pid_t process_;
};

TEST(OutputFolderTest, AKilledProcessLeavesNoLock) {
  const test::TestFolder tests;
  LockingProcess other(tests.path());
  EXPECT_NE(test::error_of([&] { FolderLock lock(tests.path()); }), "");
  other.kill_it();
  EXPECT_EQ(test::error_of([&] { FolderLock lock(tests.path()); }), "");
}

TEST(OutputFolderTest, AFolderThatCannotBeMadeIsNamed) {
  const test::TestFolder tests;
  const fs::path file = tests.write("file", "x");
  EXPECT_THAT(test::error_of([&] { FolderLock lock(file / "below"); }),
              HasSubstr("file/below: cannot be created: Not a directory"));
  EXPECT_THAT(test::error_of([&] { FolderLock lock(file); }), HasSubstr(file.string()));
  EXPECT_THAT(test::error_of([&] { create_inner_folder(file); }), HasSubstr("Not a directory"));
  EXPECT_THAT(test::error_of([&] { create_inner_folder(file / "below"); }),
              HasSubstr("Not a directory"));
}

// Its user may have put the folder itself elsewhere; what is inside of it may be another's work.
TEST(OutputFolderTest, OnlyTheFolderItselfMayBeALink) {
  const test::TestFolder tests;
  fs::create_directories(tests / "elsewhere");
  fs::create_directory_symlink(tests / "elsewhere", tests / "out");
  const FolderLock lock(tests / "out");
  create_inner_folder(tests / "out/images/left");
  create_inner_folder(tests / "out/images/left");
  EXPECT_TRUE(fs::is_directory(tests / "elsewhere/images/left"));
  fs::create_directory_symlink(tests / "elsewhere", tests / "out/frames");
  EXPECT_THAT(test::error_of([&] { create_inner_folder(tests / "out/frames"); }),
              HasSubstr("out/frames: is a link"));
  fs::create_directory_symlink(tests / "nowhere", tests / "out/dangling");
  EXPECT_THAT(test::error_of([&] { create_inner_folder(tests / "out/dangling"); }),
              HasSubstr("out/dangling: is a link"));
  EXPECT_FALSE(fs::exists(tests / "nowhere"));
}

TEST(OutputFolderTest, ATemporaryFolderIsForThisUserAndGoesWithItsObject) {
  const test::TestFolder tests;
  fs::path path;
  {
    const TemporaryFolder first(tests.path());
    const TemporaryFolder second(tests.path());
    path = first.path();
    EXPECT_EQ(path.parent_path(), tests.path());
    EXPECT_NE(path, second.path());
    struct stat status {};
    ASSERT_EQ(stat(path.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0700u);
    write_file_atomically(path / "x", "x");
  }
  EXPECT_FALSE(fs::exists(path));
  EXPECT_THAT(test::error_of([&] { TemporaryFolder(tests / "none"); }), HasSubstr("none/"));
}

}  // namespace
}  // namespace vinebench
