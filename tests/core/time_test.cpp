// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/time.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/util/error.h"

namespace vinebench {
namespace {

TEST(TimeTest, FramesAtFifteenHertzAreTheNearestNanosecond) {
  EXPECT_EQ(stamp_of_frame(0, 15), 0);
  EXPECT_EQ(stamp_of_frame(1, 15), 66'666'667);   // 66,666,666.67
  EXPECT_EQ(stamp_of_frame(2, 15), 133'333'333);  // 133,333,333.33
  EXPECT_EQ(stamp_of_frame(3, 15), 200'000'000);
}

TEST(TimeTest, StampsDoNotDrift) {
  // A day has 15 * 86,400 frames and ends on a whole second; steps of 66,666,667 ns would be 0.4 s
  // late by then.
  const std::int64_t day = 15 * 86'400;
  EXPECT_EQ(stamp_of_frame(day, 15), 86'400 * kNanosecondsPerSecond);
  for (std::int64_t i = day; i < day + 1000; ++i) {
    const Stamp gap = stamp_of_frame(i + 1, 15) - stamp_of_frame(i, 15);
    EXPECT_TRUE(gap == 66'666'666 || gap == 66'666'667) << i << ": " << gap;
  }
}

TEST(TimeTest, RatesNeedNotBeWhole) {
  // 7.5 Hz: 2/15 s a frame, so 3 frames are 0.4 s.
  EXPECT_EQ(stamp_of_frame(1, 7.5), 133'333'333);
  EXPECT_EQ(stamp_of_frame(3, 7.5), 400'000'000);
}

TEST(TimeTest, SecondsAreReadAndWrittenExactly) {
  EXPECT_EQ(format_seconds(12'066'666'667), "12.066666667");
  EXPECT_EQ(format_seconds(-500'000'000), "-0.500000000");
  for (const Stamp stamp : {Stamp{0}, Stamp{1}, Stamp{-1}, Stamp{999'999'999},
                            Stamp{1403715273'262142976}, Stamp{-12'066'666'667}}) {
    EXPECT_EQ(parse_seconds(format_seconds(stamp)), stamp);
  }
}

TEST(TimeTest, ReadsWhatPeopleWrite) {
  EXPECT_EQ(parse_seconds("12"), 12 * kNanosecondsPerSecond);
  EXPECT_EQ(parse_seconds("+0.5"), 500'000'000);
  EXPECT_EQ(parse_seconds(".25"), 250'000'000);
  EXPECT_EQ(parse_seconds("1."), kNanosecondsPerSecond);
  EXPECT_EQ(parse_seconds("1.5e-3"), 1'500'000);
  // More decimals than a nanosecond has: the nearest one.
  EXPECT_EQ(parse_seconds("0.12345678951"), 123'456'790);
}

// 2^62 ns are 4,611,686,018 s: the differences of two such times are below 2^63 ns.
TEST(TimeTest, DifferencesOfTimesAreTimes) {
  EXPECT_EQ(parse_seconds("4611686018.427387903"), kMostStamp);
  EXPECT_EQ(parse_seconds("-4611686018.427387903"), -kMostStamp);
  EXPECT_EQ(from_seconds(1e300), kMostStamp);
  EXPECT_EQ(from_seconds(-1e300), -kMostStamp);
  EXPECT_EQ(kMostStamp - -kMostStamp, std::numeric_limits<Stamp>::max() - 1);
}

TEST(TimeTest, WhatIsNoTimeIsAnErrorThatQuotesIt) {
  for (const char* text : {"", "x", "1.2.3", "1 s", "--1", "1-2", "nan", "inf", ".", "-.", "-",
                           "99999999999999999999", "1e300", "-1e300", "4.7e9", "-4700000000.5"}) {
    EXPECT_THAT([&] { parse_seconds(text); },
                testing::ThrowsMessage<Error>(
                    testing::HasSubstr(std::string("expected a time in seconds, found '") + text)))
        << text;
  }
}

}  // namespace
}  // namespace vinebench
