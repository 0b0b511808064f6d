// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/config/field_list.h"

#include <gtest/gtest.h>

#include "tests/support/example_config.h"

namespace vinebench {
namespace {

/// "key: type, default; range", and whose it is in the test's namespace.
std::string line_of(const ConfigField& field) {
  std::string line = field.key + ": " + field.type;
  if (!field.value.empty()) line += ", " + field.value;
  if (!field.range.empty()) line += "; " + field.range;
  return line;
}

TEST(FieldList, HasEveryKeyWithTypeDefaultAndRange) {
  const std::vector<std::string> expected{"count: whole number, 3; 0 to 10",
                                          "on: true or false, false",
                                          "colour: one of red, green, red",
                                          "name: text, \"x\"",
                                          "names: any number of texts, []",
                                          "position: 3 numbers, [0, 0, 0]",
                                          "maybe: number",
                                          "inner: map",
                                          "inner.radius: number, 1; above 0",
                                          "list: list of maps, []",
                                          "list.N.radius: number, 1; above 0",
                                          "colours: map by name, {}",
                                          "colours.NAME: one of red, green"};
  std::vector<std::string> lines;
  for (const ConfigField& field : list_fields<test::Outer>()) lines.push_back(line_of(field));
  EXPECT_EQ(lines, expected);
}

TEST(FieldList, SaysWhoseAKeyIs) {
  const std::vector<ConfigField> fields = list_fields<test::Outer>();
  EXPECT_EQ(fields.front().owner, "vinebench::test::Outer");
  EXPECT_EQ(fields.at(8).key, "inner.radius");
  EXPECT_EQ(fields.at(8).owner, "vinebench::test::Inner");
  EXPECT_EQ(fields.at(8).own_key, "radius");
}

struct Halves {
  std::optional<test::Inner> first;
  std::optional<test::Inner> second = test::Inner{2};
  std::vector<double> numbers{1, 2.5};
  double most = 0;
  double open = 0;
  template <class Archive>
  void serialize(Archive& archive) {
    archive("first", first);
    archive("second", second);
    archive("numbers", numbers);
    archive("most", most, Range{-std::numeric_limits<double>::infinity(), 3});
    archive("open", open, Range{0, 2, true});
  }
};

TEST(FieldList, HasTheKeysOfPartsThatAreAbsent) {
  const std::vector<std::string> expected{"first: map, absent by default",
                                          "first.radius: number, 1; above 0",
                                          "second: map",
                                          "second.radius: number, 2; above 0",
                                          "numbers: any number of numbers, [1, 2.5]",
                                          "most: number, 0; at most 3",
                                          "open: number, 0; above 0 to 2"};
  std::vector<std::string> lines;
  for (const ConfigField& field : list_fields<Halves>()) lines.push_back(line_of(field));
  EXPECT_EQ(lines, expected);
}

}  // namespace
}  // namespace vinebench
