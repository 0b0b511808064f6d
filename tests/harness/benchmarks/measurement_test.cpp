// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/benchmarks/measurement.h"

#include <gtest/gtest.h>

#include "core/util/error.h"

namespace vinebench::harness {
namespace {

TEST(MedianTest, IsTheMiddleValueAndOfTwoTheUpper) {
  EXPECT_EQ(median(std::vector<double>{5, 1, 9}), 5);
  EXPECT_EQ(median(std::vector<double>{3, 1, 4, 2}), 3);
  EXPECT_THROW(median(std::vector<double>{}), Error);
  const Timing timing = median(std::vector<Timing>{{1, 30}, {2, 20}, {3, 10}});
  EXPECT_EQ(timing.cpu_ms, 2);
  EXPECT_EQ(timing.wall_ms, 20);
}

TEST(MeasureTest, CountsTheTimeOfTheWork) {
  volatile double sum = 0;
  const Timing timing = measure([&] {
    for (int i = 0; i < 1'000'000; ++i) sum = sum + 1;
  });
  // A million dependent additions through memory take at least a cycle each: 0.1 ms at 10 GHz.
  EXPECT_GT(timing.cpu_ms, 0.1);
  EXPECT_GT(timing.wall_ms, 0.1);
}

}  // namespace
}  // namespace vinebench::harness
