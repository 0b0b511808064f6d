// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/files/json_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/special_files.h"

namespace vinebench::harness {
namespace {

using nlohmann::ordered_json;
using test::error_of;
using testing::AllOf;
using testing::HasSubstr;

TEST(JsonFileTest, ComesBack) {
  const test::TestFolder folder;
  const ordered_json json{{"name",
                           "Rebst\xc3\xb6"
                           "cke"},
                          {"rows", {1, 2}}};
  EXPECT_EQ(read_json(folder.write("a.json", json_text(json))), json);
  EXPECT_EQ(read_json(folder.write("a.json", json_text(json, 2))), json);
  EXPECT_EQ(json_text(json, 2).substr(0, 4), "{\n  ");
}

TEST(JsonFileTest, BytesThatAreNotUtf8AreReplaced) {
  EXPECT_EQ(json_text(ordered_json("out/\xff")), "\"out/\xef\xbf\xbd\"");
}

TEST(JsonFileTest, WhatIsNoJsonIsNamed) {
  const test::TestFolder folder;
  const auto problem = [&](const std::string& text) {
    const auto file = folder.write("bad.json", text);
    const std::string error = error_of([&] { read_json(file); });
    EXPECT_THAT(error, HasSubstr(file.string()));
    return error;
  };
  EXPECT_THAT(problem("{\"a\": "), HasSubstr("is not valid JSON"));
  EXPECT_THAT(problem("\"\xff\""), HasSubstr("is not valid JSON"));
  EXPECT_THAT(problem(std::string(1'000'000, '[')), HasSubstr("nested more than"));
  const auto pipe = test::make_pipe(folder, "pipe.json");
  EXPECT_THAT(error_of([&] { read_json(pipe); }), HasSubstr("a pipe or a device"));
}

}  // namespace
}  // namespace vinebench::harness
