// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/config/config_field.h"

#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace vinebench {
namespace {

TEST(RangeTest, ItsEndsBelongToItExceptForPositiveNumbers) {
  EXPECT_TRUE(Range::between(1, 2).contains(1));
  EXPECT_TRUE(Range::between(1, 2).contains(2));
  EXPECT_FALSE(Range::between(1, 2).contains(2.0001));
  EXPECT_TRUE(Range::non_negative().contains(0));
  EXPECT_FALSE(Range::non_negative().contains(-1e-9));
  EXPECT_FALSE(Range::positive().contains(0));
  EXPECT_TRUE(Range::positive().contains(1e-9));
  EXPECT_TRUE(Range{}.contains(-1e300));
}

TEST(RangeTest, SaysWhatItExpects) {
  EXPECT_EQ(Range::between(0.5, 2).text(), "a number of at least 0.5 and at most 2");
  EXPECT_EQ((Range{0, 2, true}).text(), "a number above 0 and at most 2");
  EXPECT_EQ(Range::positive().text(), "a number above 0");
  EXPECT_EQ(Range::non_negative().text(), "a number of at least 0");
  EXPECT_EQ((Range{.max = 3}).text(), "a number of at most 3");
  EXPECT_EQ(Range{}.text(), "a finite number");
}

TEST(ThrowViolationsTest, ListsAllInOneError) {
  EXPECT_EQ(test::error_of([] { throw_violations({"a: one", "b: two"}); }), "a: one\nb: two");
  EXPECT_NO_THROW(throw_violations({}));
}

}  // namespace
}  // namespace vinebench
