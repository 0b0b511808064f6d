// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/geometry/weld_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace vinebench::sim {
namespace {

using Item = std::array<std::int32_t, 2>;

TEST(WeldTableTest, EqualItemsHaveTheNumberOfTheFirst) {
  WeldTable<Item> table;
  EXPECT_EQ(table.index_of({1, 2}), 0u);
  EXPECT_EQ(table.index_of({2, 1}), 1u);
  EXPECT_EQ(table.index_of({1, 2}), 0u);
  EXPECT_THAT(table.take(), testing::ElementsAre(Item{1, 2}, Item{2, 1}));
  EXPECT_EQ(table.index_of({2, 1}), 0u);  // empty again
}

TEST(WeldTableTest, NumbersStayAsTheTableGrows) {
  WeldTable<Item> table;
  for (int round = 0; round < 2; ++round) {
    for (std::int32_t i = 0; i < 10'000; ++i) {
      ASSERT_EQ(table.index_of({i % 100, i / 100}), static_cast<std::uint32_t>(i));
    }
  }
  EXPECT_EQ(table.items().size(), 10'000u);
}

}  // namespace
}  // namespace vinebench::sim
