// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/util/suggestion.h"

#include <gtest/gtest.h>

namespace vinebench {
namespace {

TEST(SuggestionTest, CountsEdits) {
  EXPECT_EQ(edit_distance("seed", "seed"), 0);
  EXPECT_EQ(edit_distance("", "seed"), 4);
  EXPECT_EQ(edit_distance("seed", ""), 4);
  EXPECT_EQ(edit_distance("sed", "seed"), 1);        // an e more
  EXPECT_EQ(edit_distance("sede", "seed"), 1);       // two neighbours swapped
  EXPECT_EQ(edit_distance("radios", "radius"), 1);   // one replaced
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);  // k to s, e to i, a g more
}

TEST(SuggestionTest, NamesTheNearest) {
  const std::vector<std::string> names{"run", "replay", "record", "render"};
  EXPECT_EQ(did_you_mean("rplay", names), "; did you mean 'replay'?");
  EXPECT_EQ(did_you_mean("rnu", names), "; did you mean 'run'?");
  EXPECT_EQ(did_you_mean("recorder", names), "; did you mean 'record'?");  // 2 of 8
  EXPECT_EQ(did_you_mean("fly", names), "");                               // 3 of 3 to run
  EXPECT_EQ(did_you_mean("rex", names), "");                               // 2 of 3 to run
  EXPECT_EQ(did_you_mean("run", {}), "");
}

TEST(SuggestionTest, TakesTheFirstOfEquals) {
  EXPECT_EQ(did_you_mean("csl-3", {"csl-1", "csl-2"}), "; did you mean 'csl-1'?");
}

}  // namespace
}  // namespace vinebench
