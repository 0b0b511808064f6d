// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/patches/patch_list.h"

#include <gtest/gtest.h>

namespace vinebench::slam {
namespace {

Patch grey(std::uint8_t level) {
  Patch patch;
  patch.grey.fill(level);
  return patch;
}

TEST(PatchListTest, FindsWhatWasAddedAndNothingElse) {
  PatchList list(4);
  list.add(2, grey(20));
  list.add(0, grey(10));
  list.close();
  EXPECT_EQ(list.size(), 4u);
  ASSERT_NE(list.find(0), nullptr);
  ASSERT_NE(list.find(2), nullptr);
  EXPECT_EQ(list.find(0)->grey[7], 10);
  EXPECT_EQ(list.find(2)->grey[7], 20);
  EXPECT_EQ(list.find(1), nullptr);
  EXPECT_EQ(list.find(3), nullptr);
}

TEST(PatchListTest, KeepsThePatchesOfTiedFeatures) {
  PatchList list(4);
  list.add(2, grey(20));
  list.add(0, grey(10));
  list.close();
  list.keep_tied({-1, 5, 7, -1});
  EXPECT_EQ(list.size(), 4u);
  EXPECT_EQ(list.find(0), nullptr);
  EXPECT_EQ(list.find(1), nullptr);
  ASSERT_NE(list.find(2), nullptr);
  EXPECT_EQ(list.find(2)->grey[7], 20);
}

}  // namespace
}  // namespace vinebench::slam
