// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/realism/realism_fit.h"

#include <gmock/gmock.h>

#include "core/util/error.h"
#include "tests/support/eleven_pictures.h"

namespace vinebench::harness {
namespace {

using test::eleven;

// Draw i gives pictures of scale i / 10: the quarter nearest to 1 of twelve are 10, 9 and 11.
TEST(RealismFitTest, KeepsTheNearestQuarter) {
  const RealismFit fit = search_settings(eleven("real", 1), 12, [](std::int64_t draw) {
    return eleven("ours", static_cast<double>(draw) / 10);
  });
  EXPECT_EQ(fit.tried.front().draw, 10);
  EXPECT_EQ(fit.tried.front().distance, 0);
  EXPECT_THAT(fit.nearest, testing::UnorderedElementsAre(9, 10, 11));
  EXPECT_THROW(search_settings(eleven("real", 1), 7, [](std::int64_t) { return PictureSet(); }),
               Error);
}

}  // namespace
}  // namespace vinebench::harness
