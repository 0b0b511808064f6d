// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0

#include "core/config/yaml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/util/error.h"
#include "tests/support/example_config.h"
#include "tests/support/test_folder.h"

namespace vinebench {
namespace {

using test::Outer;

class YamlTest : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    return folder_.write(name, text);
  }
  std::string error_of(const std::string& text) const {
    return test::error_of([&] { YamlDocument::load(write("bad.yaml", text)).read<Outer>(); });
  }

 private:
  test::TestFolder folder_;
};

TEST_F(YamlTest, ReadsEveryKindOfField) {
  const Outer outer = YamlDocument::load(write("good.yaml", R"(count: 4
on: true
colour: green
name: vine
names: one
position: [1, 2.5, -3]
maybe: 0.5
inner: {radius: 2}
list:
  - radius: 3
  - {}
)"))
                          .read<Outer>();
  EXPECT_EQ(outer.count, 4);
  EXPECT_TRUE(outer.on);
  EXPECT_EQ(outer.colour, test::Colour::kGreen);
  EXPECT_EQ(outer.names, std::vector<std::string>{"one"});
  EXPECT_EQ(outer.position, Eigen::Vector3d(1, 2.5, -3));
  EXPECT_EQ(outer.maybe, 0.5);
  EXPECT_EQ(outer.inner.radius, 2);
  ASSERT_EQ(outer.list.size(), 2u);
  EXPECT_EQ(outer.list[0].radius, 3);
  EXPECT_EQ(outer.list[1].radius, 1);
}

TEST_F(YamlTest, NamesFileLineKeyFoundAndExpected) {
  EXPECT_THAT(error_of("on: true\ncount: many\n"),
              testing::HasSubstr("bad.yaml:2: count: expected a whole number of at least 0 and at "
                                 "most 10, found 'many'"));
  EXPECT_THAT(
      error_of("inner:\n  radius: -1\n"),
      testing::HasSubstr("bad.yaml:2: inner.radius: expected a number above 0, found '-1'"));
  EXPECT_THAT(error_of("inner:\n  radios: 1\n"),
              testing::HasSubstr("bad.yaml:2: inner.radios: unknown key, expected one of: radius"));
  EXPECT_THAT(error_of("position: [1, 2]\n"), testing::HasSubstr("position: expected a list of 3"));
  EXPECT_THAT(error_of("inner: {radius: .nan}\n"), testing::HasSubstr("inner.radius"));
  EXPECT_THAT(error_of("colour: blue\n"), testing::HasSubstr("expected one of: red, green"));
  EXPECT_THAT(error_of("list: 5\n"), testing::HasSubstr("list: expected a list, found '5'"));
  EXPECT_THAT(error_of("count: 7\n"), testing::HasSubstr("count: expected anything but 7"));
  EXPECT_THAT(error_of("a: [1\n"), testing::HasSubstr("is not valid YAML"));
}

TEST_F(YamlTest, ListsEveryViolationAtOnce) {
  const std::string text = error_of("count: 99\nnope: 1\non: perhaps\n");
  EXPECT_THAT(text, testing::HasSubstr("count"));
  EXPECT_THAT(text, testing::HasSubstr("nope"));
  EXPECT_THAT(text, testing::HasSubstr("on"));
}

TEST_F(YamlTest, DuplicateKeysAreErrors) {
  EXPECT_THAT(error_of("count: 1\ncount: 2\n"),
              testing::HasSubstr("bad.yaml:2: count: duplicate key"));
}

TEST_F(YamlTest, MissingFileIsNamed) {
  EXPECT_THAT([] { YamlDocument::load("/nowhere/x.yaml"); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("/nowhere/x.yaml")));
}

TEST_F(YamlTest, OverridesReplaceAndAreNamedInErrors) {
  YamlDocument document = YamlDocument::load(write("o.yaml", "list: [{radius: 3}]\n"));
  document.set("list.0.radius", "4");
  document.set("inner.radius", "5");
  const Outer outer = document.read<Outer>();
  EXPECT_EQ(outer.list[0].radius, 4);
  EXPECT_EQ(outer.inner.radius, 5);

  document.set("inner.radios", "5");
  EXPECT_THAT([&] { document.read<Outer>(); },
              testing::ThrowsMessage<Error>(
                  testing::HasSubstr("--set inner.radios=5: inner.radios: unknown key")));
  EXPECT_THAT([&] { document.set("list.3.radius", "1"); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("not an index into a list of 1")));
}

TEST_F(YamlTest, IncludedFilesKeepTheirOwnPlaces) {
  write("inner.yaml", "# a comment\nradius: -2\n");
  YamlDocument document = YamlDocument::load(write("outer.yaml", "inner: inner.yaml\n"));
  document.include("inner");
  EXPECT_THAT([&] { document.read<Outer>(); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("inner.yaml:2: inner.radius")));
  document = YamlDocument::load(write("outer.yaml", "on: true\ninner: none.yaml\n"));
  EXPECT_THAT(
      [&] { document.include("inner"); },
      testing::ThrowsMessage<Error>(testing::HasSubstr("outer.yaml:2: inner: expected a file")));
}

}  // namespace
}  // namespace vinebench
