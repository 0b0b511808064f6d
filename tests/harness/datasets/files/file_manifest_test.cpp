// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/files/file_manifest.h"

#include <gmock/gmock.h>

#include "tests/support/special_files.h"

namespace vinebench::harness {
namespace {

TEST(FileManifestTest, AFileHasTheHashOfItsBytes) {
  const test::TestFolder folder;
  // Around the megabyte that is read at once, and of several.
  for (const std::size_t size : {0u, 1u, 1048575u, 1048576u, 1048577u, 3000000u}) {
    std::string bytes(size, 'v');
    for (std::size_t i = 0; i < size; i += 7) bytes[i] = static_cast<char>(i);
    EXPECT_EQ(xxh128_of_file(folder.write("file", bytes)), xxh128(bytes)) << size;
  }
  // As `xxhsum -H128` of an empty file prints it.
  EXPECT_EQ(xxh128(""), "99aa06d3014798d86001c324468d497f");
  EXPECT_THAT(test::error_of([&] { xxh128_of_file(folder / "none"); }),
              testing::HasSubstr("cannot be read: No such file"));
}

TEST(FileManifestTest, LinksThatLeadNowhereAreNoFiles) {
  const test::TestFolder folder;
  folder.write("file", "");
  test::make_loop(folder, "loop");
  test::make_pipe(folder, "pipe");
  EXPECT_THAT(files_below(folder.path()), testing::ElementsAre("file"));
}

TEST(FileManifestTest, BytesOfAFileWithTwoNamesCountOnce) {
  const test::TestFolder folder;
  folder.write("a", "four");
  folder.write("b", "three");
  std::filesystem::create_hard_link(folder / "a", folder / "c");
  EXPECT_EQ(bytes_below(folder.path()), 9u);  // 4 + 5
}

TEST(FileManifestTest, APipeHasNoHash) {
  const test::TestFolder folder;
  const auto pipe = test::make_pipe(folder, "pipe");
  EXPECT_THAT(test::error_of([&] { xxh128_of_file(pipe); }),
              testing::HasSubstr("a pipe or a device"));
}

}  // namespace
}  // namespace vinebench::harness
