// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world/daylight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/util/error.h"

namespace vinebench::sim {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

TEST(SunPositionTest, StandsHighInTheSouthAtMidsummerNoon) {
  // The declination is the obliquity, 23.44 degrees, so at culmination over 45 degrees north the
  // sun is 90 - 45 + 23.44 = 68.44 degrees high. The equation of time is -1.8 minutes on that day:
  // at 12:00 UTC in Greenwich the sun has 0.45 degrees of hour angle to go, which are 0.45
  // cos(23.44) / cos(68.44) = 1.12 degrees of azimuth.
  const SunPosition sun = sun_position({45, 0, "2026-06-21", "12:00"});
  EXPECT_NEAR(sun.elevation * kDegrees, 68.44, 0.02);
  EXPECT_NEAR(sun.azimuth * kDegrees, 180 - 1.12, 0.15);
}

TEST(SunPositionTest, RisesInTheEastAtTheEquinox) {
  // March 20, 2026: the declination passes zero at 14:46 UTC. On the equator the hour angle at
  // 06:00 is -90 degrees less the equation of time, -7.4 minutes or -1.85 degrees.
  const SunPosition sun = sun_position({0, 0, "2026-03-20", "06:00"});
  EXPECT_NEAR(sun.elevation * kDegrees, -1.85, 0.1);
  EXPECT_NEAR(sun.azimuth * kDegrees, 90, 0.2);
}

TEST(SunPositionTest, FollowsTheLongitudeByFourMinutesADegree) {
  const SunPosition greenwich = sun_position({40, 0, "2026-09-15", "12:00"});
  const SunPosition east = sun_position({40, 15, "2026-09-15", "11:00"});
  // In that hour the sun itself moves 1/24 of its degree a day along the ecliptic.
  EXPECT_NEAR(east.elevation, greenwich.elevation, 0.05 / kDegrees);
  EXPECT_NEAR(east.azimuth, greenwich.azimuth, 0.1 / kDegrees);
}

TEST(SunPositionTest, RefusesWhatIsNoDate) {
  EXPECT_THROW(sun_position({0, 0, "2026-02-30", "12:00"}), Error);
  EXPECT_THROW(sun_position({0, 0, "20.2.2026", "12:00"}), Error);
  EXPECT_THROW(sun_position({0, 0, "2026-02-20", "24:00"}), Error);
  EXPECT_THROW(sun_position({0, 0, "2026-02-20", "noon"}), Error);
}

TEST(DaylightTest, TheDefaultIsTheNominalLight) {
  const Light light = daylight({}, {});
  const Light nominal;
  EXPECT_LT((light.sun - nominal.sun).norm(), 1e-6f);
  EXPECT_LT((light.sky - nominal.sky).norm(), 1e-6f);
  EXPECT_LT((light.bounce - nominal.bounce).norm(), 1e-3f);  // its norm is rounded in the code
  EXPECT_EQ(light.haze, 0);
}

TEST(DaylightTest, ALowSunIsDimAndRed) {
  SunConfig low;
  low.elevation_deg = 5;
  const Light light = daylight(low, {});
  // Air masses of 10.3 and 1.30 (Kasten and Young): exp(-0.12 * 9) = 0.34 of the red is left, and
  // exp(-0.26 * 9) = 0.096 of the blue.
  EXPECT_NEAR(light.sun.x(), 0.34, 0.01);
  EXPECT_NEAR(light.sun.z(), 0.096, 0.005);
  EXPECT_LT(light.sky.norm(), Light{}.sky.norm());
}

TEST(DaylightTest, BelowTheHorizonThereIsTwilightWithoutSun) {
  SunConfig set;
  set.elevation_deg = -3;
  const Light light = daylight(set, {});
  EXPECT_EQ(light.sun.norm(), 0);
  EXPECT_GT(light.sky.minCoeff(), 0);
  EXPECT_LT(light.sky.maxCoeff(), 0.1f);
}

TEST(DaylightTest, AnOvercastSkyHasNoSunAndHazeHidesBeyondItsVisibility) {
  SkyConfig sky;
  sky.overcast = 1;
  sky.visibility = 100;
  const Light light = daylight({}, sky);
  EXPECT_EQ(light.sun.norm(), 0);
  EXPECT_NEAR(std::exp(-static_cast<double>(light.haze) * 100), 0.02, 1e-4);  // by definition
}

// The sun's light falls with the square of the clear share: of 0.5 a quarter is left.
TEST(DaylightTest, TheSeasonsCloudsCountWhereTheWorldGivesNone) {
  SkyConfig sky;
  const float clear = daylight({}, sky).sun.x();
  EXPECT_NEAR(daylight({}, sky, 0.5).sun.x(), 0.25f * clear, 1e-6f);
  sky.overcast = 0;
  EXPECT_EQ(daylight({}, sky, 0.5).sun.x(), clear);
}

}  // namespace
}  // namespace vinebench::sim
