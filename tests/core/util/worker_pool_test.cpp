// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/util/worker_pool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>

#include "core/util/error.h"
#include "core/util/random.h"

namespace vinebench {
namespace {

class WorkerPoolTest : public testing::TestWithParam<int> {};

TEST_P(WorkerPoolTest, CallsEveryItemOnceRoundAfterRound) {
  WorkerPool pool(GetParam());
  EXPECT_EQ(pool.threads(), GetParam());
  for (std::size_t round = 0; round < 200; ++round) {
    std::vector<std::atomic<int>> calls(round);
    pool.for_each(round, [&](std::size_t i) { ++calls.at(i); });
    for (std::size_t i = 0; i < round; ++i) ASSERT_EQ(calls[i], 1) << round << ", " << i;
  }
}

TEST_P(WorkerPoolTest, GivesTheSameResultForAnyNumberOfThreads) {
  const auto work = [](WorkerPool& pool) {
    std::vector<double> slots(1000);
    const RandomStream stream(1, "work");
    pool.for_each(slots.size(), [&](std::size_t i) { slots[i] = stream.normal(i); });
    return slots;
  };
  WorkerPool alone(1);
  WorkerPool pool(GetParam());
  EXPECT_EQ(work(pool), work(alone));
}

TEST_P(WorkerPoolTest, RethrowsTheExceptionOfTheLowestItemAfterAllAreDone) {
  WorkerPool pool(GetParam());
  for (int round = 0; round < 50; ++round) {
    std::atomic<int> done = 0;
    EXPECT_THAT(
        [&] {
          pool.for_each(20, [&](std::size_t i) {
            ++done;
            if (i % 7 == 3) fail("item {}", i);  // 3, 10, 17
          });
        },
        testing::ThrowsMessage<Error>("item 3"));
    EXPECT_EQ(done, 20);
  }
  // The pool remains usable.
  int calls = 0;
  pool.for_each(1, [&](std::size_t) { ++calls; });
  EXPECT_EQ(calls, 1);
}

INSTANTIATE_TEST_SUITE_P(Threads, WorkerPoolTest, testing::Values(1, 2, 4));

}  // namespace
}  // namespace vinebench
