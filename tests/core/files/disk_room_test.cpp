// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/files/disk_room.h"

#include <gtest/gtest.h>

#include <cerrno>

#include "tests/support/size_limit.h"
#include "tests/support/test_folder.h"

namespace vinebench {
namespace {

TEST(DiskRoomTest, AFileMayGrowToTheLimitOfItsSize) {
  const test::TestFolder folder;
  const auto file = folder.write("a", std::string(600, 'x'));
  const test::SizeLimit limit(1000);
  EXPECT_EQ(lack_of_room(file, 400), 0);
  EXPECT_EQ(lack_of_room(file, 401), EFBIG);
  EXPECT_EQ(lack_of_room(folder / "new", 1000), 0);
  EXPECT_EQ(lack_of_room(folder / "new", 1001), EFBIG);
}

TEST(DiskRoomTest, NoDiskHasAnExbibyte) {
  const test::TestFolder folder;
  EXPECT_EQ(lack_of_room(folder / "a", std::uint64_t{1} << 60), ENOSPC);
  EXPECT_EQ(lack_of_room(folder / "a", 1), 0);
}

}  // namespace
}  // namespace vinebench
