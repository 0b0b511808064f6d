// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/config/override.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace vinebench {
namespace {

TEST(OverrideTest, SplitsAtTheFirstEqualsSign) {
  EXPECT_EQ(parse_override("a.b=3"), Override("a.b", "3"));
  EXPECT_EQ(parse_override("name=x=y"), Override("name", "x=y"));
  EXPECT_EQ(parse_override("a="), Override("a", ""));
}

TEST(OverrideTest, AKeyAndAnEqualsSignAreRequired) {
  for (const char* text : {"", "a", "=3"}) {
    EXPECT_THAT(test::error_of([&] { parse_override(text); }),
                testing::StartsWith(std::string("--set ") + text + ": expected KEY=VALUE"));
  }
}

}  // namespace
}  // namespace vinebench
