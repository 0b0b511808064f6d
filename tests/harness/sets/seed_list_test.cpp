// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sets/seed_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(SeedListTest, ReadsNumbersAndRanges) {
  EXPECT_THAT(parse_seeds("3"), ElementsAre(3));
  EXPECT_THAT(parse_seeds("1..5"), ElementsAre(1, 2, 3, 4, 5));
  EXPECT_THAT(parse_seeds("7,1..2,0"), ElementsAre(7, 1, 2, 0));
}

TEST(SeedListTest, SaysWhatIsWrong) {
  const auto error = [](const char* text) { return test::error_of([&] { parse_seeds(text); }); };
  for (const char* text : {"", "one", "1-5", "1..", "..5", "1,", "-1", "1.5", "1..5..7"}) {
    EXPECT_THAT(error(text), HasSubstr("expected whole numbers")) << text;
  }
  EXPECT_THAT(error("5..1"), HasSubstr("5..1 runs backwards"));
  EXPECT_THAT(error("1..3,2"), HasSubstr("2 is repeated"));
  EXPECT_THAT(error("0..9223372036854775807"), HasSubstr("at most 10000"));
}

}  // namespace
}  // namespace vinebench::harness
