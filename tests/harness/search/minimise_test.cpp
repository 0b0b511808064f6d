// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/search/minimise.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/util/error.h"

namespace vinebench::harness {
namespace {

TEST(MinimiseTest, ComesNearTheLeastValueOfABowl) {
  double least = 1e9;
  int calls = 0;
  minimise(
      [&](const std::vector<double>& x) {
        ++calls;
        const double value = (x[0] - 0.3) * (x[0] - 0.3) + (x[1] - 0.4) * (x[1] - 0.4);
        least = std::min(least, value);
        return value;
      },
      {1, 0.5}, 60);
  EXPECT_LT(least, 0.005);  // 7 % of the box's side away
  EXPECT_LE(calls, 66);     // a division that has begun is finished
}

TEST(MinimiseTest, PassesOnWhatTheFunctionThrows) {
  EXPECT_THROW(minimise([](const std::vector<double>&) -> double { fail("no run"); }, {1}, 10),
               Error);
}

}  // namespace
}  // namespace vinebench::harness
