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
colours: {Leaf.001: green, 7: red}
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
  const std::map<std::string, test::Colour> colours{{"7", test::Colour::kRed},
                                                    {"Leaf.001", test::Colour::kGreen}};
  EXPECT_EQ(outer.colours, colours);
}

TEST_F(YamlTest, MapsOfNamesAreCheckedItemByItem) {
  EXPECT_THAT(
      error_of("colours:\n  a: red\n  b: gren\n"),
      testing::AllOf(testing::HasSubstr("bad.yaml:3: colours.b: expected one of: red, green"),
                     testing::HasSubstr("did you mean 'green'?")));
  EXPECT_THAT(error_of("colours: {a: red, a: green}\n"),
              testing::HasSubstr("colours.a: duplicate key"));
  EXPECT_THAT(error_of("colours: [red]\n"),
              testing::HasSubstr("colours: expected a map of names, found a list of 1"));
  EXPECT_THAT(error_of("colours: {[1]: red}\n"), testing::HasSubstr("expected a map of names"));
  EXPECT_EQ(error_of("colours:\n"), "");
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

// It would not be read.
TEST_F(YamlTest, ASecondDocumentIsAnError) {
  EXPECT_THAT(error_of("a: [1, 2]\n---\nb: 2\n"), testing::HasSubstr(":3: a second YAML document"));
  EXPECT_THAT(error_of("{a: [1, 2]}\nb: 2\n"), testing::HasSubstr(":2: a second YAML document"));
  EXPECT_THAT(error_of("---\na: [1\n...\n"), testing::HasSubstr("is not valid YAML"));
}

// yaml-cpp makes of this one empty document after another, without end.
TEST_F(YamlTest, ALineThatBeginsWithACommaIsAnErrorSoon) {
  EXPECT_THAT(error_of("\n, seed: 2}\ntags: [{id: 3, hr"), testing::HasSubstr("bad.yaml:"));
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

TEST_F(YamlTest, SuggestsTheNearestKeyAndName) {
  EXPECT_THAT(error_of("cuont: 4\n"), testing::HasSubstr("; did you mean 'count'?"));
  EXPECT_THAT(error_of("inner: {radios: 4}\n"), testing::HasSubstr("; did you mean 'radius'?"));
  EXPECT_THAT(error_of("zebra: 4\n"), testing::Not(testing::HasSubstr("did you mean")));
  EXPECT_THAT(error_of("colour: geen\n"),
              testing::HasSubstr("found 'geen'; did you mean 'green'?"));
}

TEST_F(YamlTest, CyclicAliasesAreErrors) {
  EXPECT_THAT(error_of("on: true\ninner: &a\n  radius: 1\n  again: *a\n"),
              testing::HasSubstr("bad.yaml:2: an alias inside of what it names"));
  EXPECT_THAT(error_of("list: &a [{radius: 1}, [*a]]\n"),
              testing::HasSubstr("bad.yaml:1: an alias inside of what it names"));
  YamlDocument document = YamlDocument::load(write("outer.yaml", "on: true\n"));
  EXPECT_THAT([&] { document.set("inner", "&a {again: *a}"); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("--set inner:1: an alias inside")));
}

TEST_F(YamlTest, CyclicAliasesInABaseAreErrors) {
  // Joining the two would go down for ever.
  const char* cyclic = "inner: &a {again: *a}\n";
  write("base.yaml", cyclic);
  EXPECT_THAT(test::error_of([&] {
                YamlDocument::load(write("own.yaml", std::string("base: base.yaml\n") + cyclic))
                    .inherit("base", {});
              }),
              testing::HasSubstr("own.yaml:2: an alias inside of what it names"));
  EXPECT_THAT(test::error_of([&] {
                YamlDocument::load(write("own.yaml", "base: base.yaml\n")).inherit("base", {});
              }),
              testing::HasSubstr("base.yaml:1: an alias inside of what it names"));
}

TEST_F(YamlTest, AliasesThatBecomeACircleByJoiningAreErrors) {
  // a, b and c of the base are one map. Joined to it, p.q gets an r that is p, and then p is joined
  // to itself.
  write("base.yaml", "a: &x {}\nb: *x\nc: *x\n");
  YamlDocument document = YamlDocument::load(
      write("own.yaml", "base: base.yaml\na: {p: &s {q: {}}}\nb: {p: {q: {r: *s}}}\nc: {p: *s}\n"));
  EXPECT_THAT([&] { document.inherit("base", {}); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("own.yaml:2: expected at most 64")));
}

TEST_F(YamlTest, DepthAndSizeAreLimited) {
  std::string deep = "1";
  for (int i = 0; i < 70; ++i) deep = "[" + deep + "]";
  EXPECT_THAT(error_of("list: " + deep + "\n"), testing::HasSubstr("at most 64 levels"));
  // Ten aliases of ten of ten ...: a line each, 10^9 parts.
  std::string text = "l0: &l0 [1]\n";
  for (int i = 1; i < 10; ++i) {
    text += fmt::format("l{0}: &l{0} [", i);
    for (int j = 0; j < 10; ++j) text += fmt::format("{}*l{}", j ? ", " : "", i - 1);
    text += "]\n";
  }
  EXPECT_THAT(error_of(text), testing::HasSubstr("at most 1000000 parts"));
}

TEST_F(YamlTest, BasesThatLeadBackAreErrors) {
  write("a.yaml", "# a comment\nbase: b.yaml\n");
  write("b.yaml", "base: a.yaml\n");
  const std::filesystem::path file = write("own.yaml", "base: a.yaml\n");
  EXPECT_THAT([&] { YamlDocument::load(file).inherit("base", {}); },
              testing::ThrowsMessage<Error>(
                  testing::AllOf(testing::HasSubstr("b.yaml:1: base: "),
                                 testing::HasSubstr("a.yaml' is derived from this file"))));
  EXPECT_THAT(
      [&] { YamlDocument::load(write("own.yaml", "base: own.yaml\n")).inherit("base", {}); },
      testing::ThrowsMessage<Error>(testing::HasSubstr("own.yaml:1: base: ")));
}

TEST_F(YamlTest, BasesInARowAreLimited) {
  write("0.yaml", "on: true\n");
  for (int i = 1; i <= 9; ++i) {
    write(fmt::format("{}.yaml", i), fmt::format("base: {}.yaml\n", i - 1));
  }
  const std::filesystem::path folder = write("8.yaml", "base: 7.yaml\n").parent_path();
  YamlDocument eight = YamlDocument::load(folder / "8.yaml");  // with eight bases
  eight.inherit("base", {});
  EXPECT_TRUE(eight.read<Outer>().on);
  EXPECT_THAT([&] { YamlDocument::load(folder / "9.yaml").inherit("base", {}); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("at most 8 files in a row")));
}

}  // namespace
}  // namespace vinebench
