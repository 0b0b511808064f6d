// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sweep/shards.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "core/util/error.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(ShardsTest, AShardIsWrittenWithASlash) {
  const Shard shard = parse_shard("3/16");
  EXPECT_EQ(shard.index, 3);
  EXPECT_EQ(shard.count, 16);
  for (const char* text : {"", "3", "/", "0/4", "5/4", "1/0", "-1/4", "1/4x", "a/b", "1/ 4"}) {
    EXPECT_THAT(test::error_of([&] { parse_shard(text); }), HasSubstr("expected I/N")) << text;
  }
}

// By falling cost: 7 to the first, 6 to the second, 5 to the third, 4 to the third (which has 5
// where the others have 6 and 7), 3 to the second, 2 to the first; each then has 9.
TEST(ShardsTest, TasksGoWhereLeastIs) {
  const std::vector<double> costs{2, 3, 4, 5, 6, 7};
  EXPECT_THAT(tasks_of({1, 3}, costs), ElementsAre(5, 0));
  EXPECT_THAT(tasks_of({2, 3}, costs), ElementsAre(4, 1));
  EXPECT_THAT(tasks_of({3, 3}, costs), ElementsAre(3, 2));
}

TEST(ShardsTest, EveryTaskIsInOneShard) {
  std::vector<double> costs;
  for (int i = 0; i < 101; ++i) costs.push_back(i * 37 % 11);
  for (const int count : {1, 2, 7, 200}) {
    std::vector<std::size_t> all;
    double least = 1e9;
    double most = 0;
    for (int i = 1; i <= count; ++i) {
      const auto tasks = tasks_of({i, count}, costs);
      all.insert(all.end(), tasks.begin(), tasks.end());
      double load = 0;
      for (const std::size_t task : tasks) load += costs[task];
      least = std::min(least, load);
      most = std::max(most, load);
    }
    std::ranges::sort(all);
    std::vector<std::size_t> expected(costs.size());
    std::iota(expected.begin(), expected.end(), 0);
    EXPECT_EQ(all, expected) << count;
    EXPECT_LE(most - least, 10) << count;  // one task's most
  }
  EXPECT_THAT(tasks_of({200, 200}, {1, 2}), IsEmpty());
}

}  // namespace
}  // namespace vinebench::harness
