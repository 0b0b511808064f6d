// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/kitti/kitti_stamps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/recorded_folders.h"

namespace vinebench::harness {
namespace {

using test::error_of;
using testing::ElementsAre;
using testing::HasSubstr;

class KittiStampsTest : public testing::Test {
 protected:
  std::vector<Stamp> read(const std::string& text) {
    test::write_text(folder_ / "timestamps.txt", text);
    return read_kitti_stamps(folder_ / "timestamps.txt");
  }
  test::TestFolder folder_;
};

TEST_F(KittiStampsTest, AreNanosecondsSince1970) {
  // 2011-09-26 is 41 years with 10 leap days (1972 to 2008) and 268 days: 15,243 days after 1970.
  constexpr Stamp kDay = 15243LL * 24 * 3600;
  EXPECT_THAT(read("2011-09-26 13:02:25.964389445\r\n2011-09-26 00:00:01\n1970-01-01 00:00:00.5\n"),
              ElementsAre((kDay + 13 * 3600 + 2 * 60 + 25) * kNanosecondsPerSecond + 964'389'445,
                          (kDay + 1) * kNanosecondsPerSecond, kNanosecondsPerSecond / 2));
}

TEST_F(KittiStampsTest, OtherTextIsAnError) {
  for (const char* line : {"2011-09-26", "2011-9-26 13:02:25", "2011-09-26 13:02", "0.1 0.2",
                           "2011-09-26 13:02:25.1234567890", "2011-09-26 13:02:25 UTC"}) {
    EXPECT_THAT(error_of([&] { read(std::string("2011-09-26 13:02:25\n") + line + "\n"); }),
                HasSubstr("timestamps.txt:2: expected a date and a time"));
  }
  for (const char* line : {"2011-02-29 13:02:25", "2011-09-26 24:00:00", "2011-09-26 13:60:00"}) {
    EXPECT_THAT(error_of([&] { read(line); }),
                HasSubstr(fmt::format("timestamps.txt:1: '{}' is not a time", line)));
  }
  EXPECT_THAT(error_of([&] { read("9999-02-28 13:02:25\n"); }), HasSubstr("within 146 years"));
}

}  // namespace
}  // namespace vinebench::harness
