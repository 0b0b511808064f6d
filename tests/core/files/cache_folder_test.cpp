// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/files/cache_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <thread>
#include <vector>

#include "tests/support/test_folder.h"

namespace vinebench {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Optional;

class CacheFolderTest : public testing::Test {
 protected:
  std::string error() const {
    return test::error_of([&] { write_cached(cache_, "x", "content"); });
  }

  test::TestFolder folder_;
  CacheFolder cache_{folder_ / "a/cache"};
};

TEST_F(CacheFolderTest, KeepsFilesInAFolderOfThisUserAlone) {
  EXPECT_EQ(read_cached(cache_, "x"), std::nullopt);
  EXPECT_FALSE(fs::exists(cache_.folder));
  const std::string bytes("a\0b\n\xff", 5);
  write_cached(cache_, "x", bytes);
  EXPECT_THAT(read_cached(cache_, "x"), Optional(bytes));
  EXPECT_EQ(fs::status(cache_.folder).permissions(), fs::perms::owner_all);
  write_cached(cache_, "x", "");
  EXPECT_THAT(read_cached(cache_, "x"), Optional(std::string()));
}

TEST_F(CacheFolderTest, WhatDoesNotMatchItsHashIsNotThere) {
  write_cached(cache_, "x", "content");
  write_cached(cache_, "y", "other");
  const fs::path file = cache_.folder / "x";
  write_file_atomically(file, "contenu");
  EXPECT_EQ(read_cached(cache_, "x"), std::nullopt);
  write_file_atomically(file, "conten");
  EXPECT_EQ(read_cached(cache_, "x"), std::nullopt);
  // Another file with its own hash: the name is part of it.
  for (const char* ending : {"", ".fnv1a"}) {
    fs::copy_file(cache_.folder / (std::string("y") + ending),
                  cache_.folder / (std::string("x") + ending),
                  fs::copy_options::overwrite_existing);
  }
  EXPECT_THAT(read_cached(cache_, "y"), Optional(std::string("other")));
  EXPECT_EQ(read_cached(cache_, "x"), std::nullopt);
  write_cached(cache_, "x", "content");
  EXPECT_THAT(read_cached(cache_, "x"), Optional(std::string("content")));
  fs::remove(cache_.folder / "x.fnv1a");
  EXPECT_EQ(read_cached(cache_, "x"), std::nullopt);
}

TEST_F(CacheFolderTest, LinksAreNeitherReadNorWrittenThrough) {
  write_cached(cache_, "x", "content");
  const fs::path target = folder_.write("target", "content");  // matches the hash
  const fs::path file = cache_.folder / "x";
  for (const char* ending : {"", ".fnv1a", ".partial"}) {
    fs::path link = file;
    link += ending;
    fs::remove(link);
    fs::create_symlink(target, link);
  }
  EXPECT_EQ(read_cached(cache_, "x"), std::nullopt);
  write_cached(cache_, "x", "content");
  EXPECT_THAT(read_cached(cache_, "x"), Optional(std::string("content")));
  EXPECT_EQ(read_file(target), "content");
  EXPECT_TRUE(fs::is_symlink(cache_.folder / "x.partial"));
}

TEST_F(CacheFolderTest, APipeInAFilesPlaceDoesNotBlock) {
  write_cached(cache_, "x", "content");
  fs::remove(cache_.folder / "x");
  ASSERT_EQ(mkfifo((cache_.folder / "x").c_str(), 0600), 0);
  EXPECT_EQ(read_cached(cache_, "x"), std::nullopt);
  write_cached(cache_, "x", "content");
  EXPECT_THAT(read_cached(cache_, "x"), Optional(std::string("content")));
}

/// The folder's parent is for all users, as /tmp is.
class PublicCacheFolderTest : public CacheFolderTest {
 protected:
  PublicCacheFolderTest() {
    fs::create_directories(cache_.folder.parent_path());
    chmod(cache_.folder.parent_path().c_str(), 01777);
  }
  void expect_refused(const std::string& reason) const {
    EXPECT_THAT(error(), HasSubstr(reason));
    EXPECT_THAT(problem_of(cache_), HasSubstr(reason));
    EXPECT_EQ(read_cached(cache_, "x"), std::nullopt);
  }
};

TEST_F(PublicCacheFolderTest, MustBeALinkForNobody) {
  write_cached({folder_ / "mine"}, "x", "content");
  fs::create_directory_symlink(folder_ / "mine", cache_.folder);
  expect_refused("cannot be used");
  cache_.folder /= "";  // after a final '/' the system would follow the link
  expect_refused("cannot be used");
  EXPECT_FALSE(fs::exists(folder_ / "mine/probe"));
}

TEST_F(PublicCacheFolderTest, MustNotBeWritableForOthers) {
  write_cached(cache_, "x", "content");
  EXPECT_THAT(read_cached(cache_, "x"), Optional(std::string("content")));
  for (const mode_t mode : {0770, 0702}) {
    chmod(cache_.folder.c_str(), mode);
    expect_refused("other users may write to it");
  }
  chmod(cache_.folder.c_str(), 0755);
  EXPECT_THAT(read_cached(cache_, "x"), Optional(std::string("content")));
}

// Only root may give a folder to another user.
TEST_F(PublicCacheFolderTest, MustBelongToThisUser) {
  write_cached(cache_, "x", "content");
  constexpr uid_t kOther = 65533;
  if (chown(cache_.folder.c_str(), kOther, static_cast<gid_t>(-1)) != 0) GTEST_SKIP() << "not root";
  expect_refused("belongs to another user");
}

TEST_F(CacheFolderTest, AFileOfAThirdUserIsNotThere) {
  write_cached(cache_, "x", "content");
  constexpr uid_t kOther = 65533;
  const fs::path file = cache_.folder / "x";
  if (chown(file.c_str(), kOther, static_cast<gid_t>(-1)) != 0) GTEST_SKIP() << "not root";
  EXPECT_EQ(read_cached(cache_, "x"), std::nullopt);
}

TEST_F(CacheFolderTest, MayBeALinkOfItsUser) {
  fs::create_directories(folder_ / "disk");
  fs::create_directories(cache_.folder.parent_path());
  fs::create_directory_symlink(folder_ / "disk", cache_.folder);
  write_cached(cache_, "x", "content");
  EXPECT_THAT(read_cached(cache_, "x"), Optional(std::string("content")));
}

// Root neither may make folders below a file or in /proc.
TEST_F(CacheFolderTest, WhyNothingCanBeKeptIsTold) {
  EXPECT_EQ(problem_of(cache_), "");
  EXPECT_TRUE(fs::is_empty(cache_.folder));
  const fs::path file = folder_.write("file", "x");
  for (const fs::path& folder : {file, file / "below", fs::path("/proc/none")}) {
    cache_.folder = folder;
    EXPECT_THAT(error(), HasSubstr(folder.string()));
    EXPECT_EQ(problem_of(cache_), error());
    EXPECT_EQ(read_cached(cache_, "x"), std::nullopt);
  }
  cache_.folder.clear();
  EXPECT_EQ(error(), "there is no folder for them");
  EXPECT_EQ(read_cached(cache_, "x"), std::nullopt);
}

TEST_F(CacheFolderTest, SeveralThreadsMayKeepTheSameFileAtOnce) {
  const std::string content(100'000, 'x');
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&] { EXPECT_NO_THROW(write_cached(cache_, "x", content)); });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(read_cached(cache_, "x"), Optional(content));
}

}  // namespace
}  // namespace vinebench
