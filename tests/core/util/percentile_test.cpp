// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/util/percentile.h"

#include <gtest/gtest.h>

namespace vinebench {
namespace {

TEST(PercentileTest, IsLinearBetweenNeighbours) {
  // Of 1, 2, 3, 4 the median is 2.5, and a quarter of the path from 1 to 4 lies at 1 + 0.75.
  EXPECT_DOUBLE_EQ(percentile({4, 1, 3, 2}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(percentile({4, 1, 3, 2}, 0.25), 1.75);
  EXPECT_DOUBLE_EQ(percentile({4, 1, 3, 2}, 1), 4);
  EXPECT_DOUBLE_EQ(percentile({0, 10, 20, 30, 40}, 0.95), 38);  // place 3.8
  EXPECT_DOUBLE_EQ(percentile({7}, 0.95), 7);
}

}  // namespace
}  // namespace vinebench
