// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/config/yaml_writer.h"

#include <gtest/gtest.h>

#include "core/config/yaml.h"
#include "tests/support/example_config.h"
#include "tests/support/test_folder.h"

namespace vinebench {
namespace {

using test::Inner;
using test::Outer;

TEST(YamlWriterTest, WrittenTextReadsBackTheSame) {
  const test::TestFolder folder;
  Outer outer;
  outer.count = 9;
  outer.name = "a \"quoted\" \\ name";
  outer.names = {"b", "c"};
  outer.position = {0.1, 1e-9, 3};
  outer.list = {Inner{2}, Inner{0.3}};
  outer.colours = {{"Leaf.001", test::Colour::kGreen}, {"a: \"b\"", test::Colour::kRed}};
  const std::string text = format_yaml(outer);
  const Outer back = YamlDocument::load(folder.write("back.yaml", text)).read<Outer>();
  EXPECT_EQ(format_yaml(back), text);
  EXPECT_EQ(back.position, outer.position);
  EXPECT_EQ(back.name, outer.name);
  EXPECT_EQ(back.colours, outer.colours);
}

// Codes from 0 to 31 and 127 may not stand in a YAML file, nor does a reader keep a carriage
// return.
TEST(YamlWriterTest, ControlCharactersAreEscaped) {
  const test::TestFolder folder;
  Outer outer;
  for (int code = 0; code < 128; ++code) outer.name += static_cast<char>(code);
  const auto file = folder.write("back.yaml", format_yaml(outer));
  EXPECT_EQ(YamlDocument::load(file).read<Outer>().name, outer.name);
}

}  // namespace
}  // namespace vinebench
