// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/files/json_depth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/util/error.h"

namespace vinebench {
namespace {

std::string nested(int levels) {
  return std::string(levels, '[') + std::string(levels, ']');
}

TEST(JsonDepthTest, UpTo200LevelsPass) {
  EXPECT_NO_THROW(check_json_depth(nested(200), "a.json"));
  EXPECT_THAT([] { check_json_depth(nested(201), "a.json"); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("a.json: its JSON is nested")));
}

TEST(JsonDepthTest, BracketsInTextsDoNotCount) {
  EXPECT_NO_THROW(check_json_depth("\"\\\"" + std::string(300, '[') + "\"", "a.json"));
}

}  // namespace
}  // namespace vinebench
