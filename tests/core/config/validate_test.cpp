// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/config/validate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/util/error.h"
#include "tests/support/example_config.h"

namespace vinebench {
namespace {

using test::Inner;
using test::Outer;

TEST(ValidateTest, ListsViolationsOfAStruct) {
  Outer outer;
  outer.count = 11;
  outer.list = {Inner{-1}};
  EXPECT_THAT([&] { validate(outer); },
              testing::ThrowsMessage<Error>(testing::AllOf(testing::HasSubstr("count: expected"),
                                                           testing::HasSubstr("list.0.radius"))));
}

}  // namespace
}  // namespace vinebench
