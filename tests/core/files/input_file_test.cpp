// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/files/input_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "core/files/files.h"
#include "tests/support/special_files.h"
#include "tests/support/test_folder.h"

namespace vinebench {
namespace {

namespace fs = std::filesystem;
using test::error_of;
using testing::AllOf;
using testing::HasSubstr;

class InputFileTest : public testing::Test {
 protected:
  /// The message for a file of that kind, which it must name.
  std::string problem(const fs::path& file, FileKind kind = FileKind::kYaml) const {
    const std::string error = error_of([&] { InputFile(file, kind); });
    EXPECT_THAT(error, HasSubstr(file.string()));
    EXPECT_EQ(error_of([&] { read_file(file, kind); }), error);
    EXPECT_EQ(error_of([&] { InputStream(file, kind); }), error);
    EXPECT_EQ(error_of([&] { check_input_file(file, kind); }), error);
    return error;
  }

  test::TestFolder folder_;
};

TEST_F(InputFileTest, IsReadInParts) {
  const auto file = folder_.write("a", "0123456789");
  InputFile in(file, FileKind::kTable);
  EXPECT_EQ(in.size(), 10u);
  std::array<char, 6> part{};
  EXPECT_EQ(in.read(part.data(), part.size()), 6u);
  EXPECT_EQ(in.read(part.data(), part.size()), 4u);
  EXPECT_EQ(std::string(part.data(), 4), "6789");
  EXPECT_EQ(in.read(part.data(), part.size()), 0u);
}

TEST_F(InputFileTest, IsReadFromAnyByteOn) {
  const InputFile in(folder_.write("a", "0123456789"), FileKind::kTable);
  std::array<char, 4> part{};
  EXPECT_EQ(in.read_at(3, part.data(), part.size()), 4u);
  EXPECT_EQ(std::string(part.data(), 4), "3456");
  EXPECT_EQ(in.read_at(8, part.data(), part.size()), 2u);
  EXPECT_EQ(std::string(part.data(), 2), "89");
  EXPECT_EQ(in.read_at(10, part.data(), part.size()), 0u);
}

TEST_F(InputFileTest, OnlyRegularFilesAndLinksToThem) {
  const auto file = folder_.write("a", "text");
  fs::create_symlink(file, folder_ / "link");
  EXPECT_EQ(read_file(folder_ / "link"), "text");
  EXPECT_THAT(problem(test::make_pipe(folder_, "pipe")), HasSubstr("a pipe or a device"));
  EXPECT_THAT(problem(test::link_to_device(folder_, "zeros")), HasSubstr("a pipe or a device"));
  EXPECT_THAT(problem(folder_.path()), HasSubstr("is a folder"));
  EXPECT_THAT(problem(folder_ / "none"), HasSubstr("No such file"));
  EXPECT_THAT(problem(test::make_loop(folder_, "loop")), HasSubstr("symbolic links"));
}

TEST_F(InputFileTest, ASocketIsNoFile) {
  const int descriptor = socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string name = (folder_ / "s").string();
  if (name.size() >= sizeof(address.sun_path)) GTEST_SKIP() << "the folder's name is too long";
  name.copy(address.sun_path, name.size());
  ASSERT_EQ(bind(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
  problem(name);
  close(descriptor);
}

// Sparse files: of one byte more than the limit.
TEST_F(InputFileTest, MoreThanTheLimitIsRefusedBeforeItIsRead) {
  const auto file = folder_.write("a", "x");
  for (const auto& [kind, text] :
       {std::pair(FileKind::kYaml, "4 MiB"), std::pair(FileKind::kTable, "256 MiB"),
        std::pair(FileKind::kJson, "1 GiB"), std::pair(FileKind::kImage, "256 MiB"),
        std::pair(FileKind::kMesh, "1 GiB"), std::pair(FileKind::kMap, "4 GiB"),
        std::pair(FileKind::kOther, "4 GiB"), std::pair(FileKind::kPart, "1024 GiB")}) {
    fs::resize_file(file, size_limit(kind) + 1);
    EXPECT_THAT(problem(file, kind), HasSubstr("expected at most " + std::string(text))) << text;
    fs::resize_file(file, size_limit(kind));
    EXPECT_NO_THROW(check_input_file(file, kind)) << text;
  }
}

// /proc states a size of 0 for its files.
TEST_F(InputFileTest, MoreThanItsStatedSizeIsReadToo) {
  EXPECT_THAT(read_file("/proc/self/status", FileKind::kTable), HasSubstr("Pid:"));
}

TEST_F(InputFileTest, AFileThatGrowsIsReadUpToTheLimit) {
  const auto file = folder_.write("a", "x");
  InputFile in(file, FileKind::kYaml);
  fs::resize_file(file, size_limit(FileKind::kYaml) + 1);
  std::string bytes(size_limit(FileKind::kYaml) + 1, ' ');
  EXPECT_THAT(error_of([&] { in.read(bytes.data(), bytes.size()); }),
              HasSubstr("expected at most 4 MiB"));
}

TEST_F(InputFileTest, ALinkThatLeadsNowhereIsPresent) {
  fs::create_symlink("gone", folder_ / "dangling");
  EXPECT_TRUE(is_present(folder_ / "dangling"));
  EXPECT_TRUE(is_present(test::make_loop(folder_, "loop")));
  EXPECT_TRUE(is_present(test::make_pipe(folder_, "pipe")));
  EXPECT_TRUE(is_present(folder_.write("file", "")));
  EXPECT_FALSE(is_present(folder_ / "none"));
}

TEST_F(InputFileTest, AStreamReadsLines) {
  const std::string filler(100'000, 'x');  // longer than what the stream keeps in memory
  const auto file = folder_.write("a", "one\n" + filler + "\nthree");
  InputStream in(file, FileKind::kTable);
  std::string line;
  std::vector<std::string> lines;
  while (std::getline(in, line)) lines.push_back(line);
  EXPECT_THAT(lines, testing::ElementsAre("one", filler, "three"));
}

TEST_F(InputFileTest, AStreamThrowsWhileItIsRead) {
  const auto file = folder_.write("a", "x");
  InputStream in(file, FileKind::kYaml);
  fs::resize_file(file, size_limit(FileKind::kYaml) + 1);
  const auto read_all = [&] {
    for (std::string part(1 << 16, ' '); in.read(part.data(), 1 << 16);) {
    }
  };
  EXPECT_THAT(error_of(read_all), HasSubstr("expected at most 4 MiB"));
}

}  // namespace
}  // namespace vinebench
