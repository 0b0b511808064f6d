// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/files/files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "core/util/error.h"
#include "tests/support/test_folder.h"

namespace vinebench {
namespace {

namespace fs = std::filesystem;

class FilesTest : public testing::Test {
 protected:
  std::set<std::string> content() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      names.insert(entry.path().filename().string());
    }
    return names;
  }
  test::TestFolder tests_;
  const fs::path folder_ = tests_.path();
};

TEST_F(FilesTest, ComesBackByteByByte) {
  const std::string bytes("a\0b\r\n\xff", 6);
  write_file_atomically(folder_ / "x", bytes);
  EXPECT_EQ(read_file(folder_ / "x"), bytes);
  write_file_atomically(folder_ / "empty", "");
  EXPECT_EQ(read_file(folder_ / "empty"), "");
}

TEST_F(FilesTest, ReplacesTheWholeFileAndLeavesNothingElse) {
  write_file_atomically(folder_ / "x", "a long first text");
  write_file_atomically(folder_ / "x", "short");
  EXPECT_EQ(read_file(folder_ / "x"), "short");
  EXPECT_EQ(content(), std::set<std::string>{"x"});
}

TEST_F(FilesTest, NamesWhatCannotBeWrittenAndWhy) {
  EXPECT_THAT([&] { write_file_atomically(folder_ / "no" / "x", "text"); },
              testing::ThrowsMessage<Error>(
                  testing::AllOf(testing::HasSubstr((folder_ / "no" / "x").string()),
                                 testing::HasSubstr("No such file or directory"))));
  write_file_atomically(folder_ / "file", "text");
  EXPECT_THAT([&] { write_file_atomically(folder_ / "file" / "x", "text"); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("Not a directory")));
}

TEST_F(FilesTest, AFailedWriteLeavesNoPartialFile) {
  fs::create_directories(folder_ / "taken" / "by a folder");
  EXPECT_THROW(write_file_atomically(folder_ / "taken", "text"), Error);
  EXPECT_EQ(content(), std::set<std::string>{"taken"});
}

TEST_F(FilesTest, NamesWhatCannotBeRead) {
  EXPECT_THAT([&] { read_file(folder_ / "none"); },
              testing::ThrowsMessage<Error>(
                  testing::AllOf(testing::HasSubstr((folder_ / "none").string()),
                                 testing::HasSubstr("No such file or directory"))));
  EXPECT_THAT([&] { read_file(folder_); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("is a folder")));
}

}  // namespace
}  // namespace vinebench
