// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/config/yaml_block.h"

#include <gtest/gtest.h>

namespace vinebench {
namespace {

TEST(YamlBlockTest, ReplacesTheKeysBlockAlone) {
  const std::string block = "b: new\n";
  EXPECT_EQ(with_block("a: 1\nb:\n  x: 1\n# of c\nc: 2\n", "b", block),
            "a: 1\nb: new\n# of c\nc: 2\n");
  EXPECT_EQ(with_block("b:\n- 1\n- 2\n\nc: 2\n", "b", block), "b: new\n\nc: 2\n");
  EXPECT_EQ(with_block("bb: 1\nb: {}\n", "b", block), "bb: 1\nb: new\n");
}

TEST(YamlBlockTest, StandsAtTheEndWhereThereIsNone) {
  EXPECT_EQ(with_block("a: 1\n", "b", "b: new\n"), "a: 1\n\nb: new\n");
  EXPECT_EQ(with_block("", "b", "b: new\n"), "b: new\n");
}

}  // namespace
}  // namespace vinebench
