// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/files/csv_field.h"

#include <gtest/gtest.h>

namespace vinebench {
namespace {

TEST(CsvFieldTest, QuotesWhatWouldEndTheField) {
  EXPECT_EQ(csv_field("front_left"), "front_left");
  EXPECT_EQ(csv_field("1.5 m, far"), "\"1.5 m, far\"");
  EXPECT_EQ(csv_field("a \"b\""), "\"a \"\"b\"\"\"");  // RFC 4180, rule 7
}

TEST(CsvFieldTest, StaysOnOneLine) {
  EXPECT_EQ(csv_field("a\nb\r,c"), "\"a_b_,c\"");
}

}  // namespace
}  // namespace vinebench
