// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/realism/realism.h"

#include <gmock/gmock.h>

#include "core/util/error.h"
#include "harness/realism/realism_fit.h"
#include "tests/support/eleven_pictures.h"

namespace vinebench::harness {
namespace {

using test::eleven;

// Of 1 to 11 the percentiles are 2, 6 and 10; the median of ours, 9, has eight below it.
TEST(RealismTest, MediansHaveTheirPlaceInTheRealRange) {
  const Realism found = compare_pictures(eleven("real", 1), eleven("ours", 1.5));
  ASSERT_EQ(found.statistics.size(), 1u);
  EXPECT_EQ(found.statistics[0].low, 2);
  EXPECT_EQ(found.statistics[0].middle, 6);
  EXPECT_EQ(found.statistics[0].high, 10);
  EXPECT_EQ(found.statistics[0].ours, 9);
  EXPECT_NEAR(found.statistics[0].share, 8.0 / 11, 1e-12);
  EXPECT_EQ(found.inside(), 1);
  EXPECT_NEAR(distance_of(found), (9.0 - 6) / 4, 1e-12);  // of the range's half, 4
}

TEST(RealismTest, WhatLiesOutsideIsNamed) {
  const Realism found = compare_pictures(eleven("real", 1), eleven("ours", 5));
  EXPECT_EQ(found.inside(), 0);
  EXPECT_EQ(distance_of(found), 3);  // (30 - 6) / 4, limited
  EXPECT_THAT(format_realism(found), testing::HasSubstr("outside"));
  EXPECT_THAT(format_realism(found), testing::HasSubstr("0 of 1 medians inside"));
}

TEST(RealismTest, OtherWidthsAreNotCompared) {
  PictureSet wide = eleven("wide", 1);
  wide.width = 1920;
  EXPECT_THROW(compare_pictures(eleven("real", 1), wide), Error);
}

}  // namespace
}  // namespace vinebench::harness
