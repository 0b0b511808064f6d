// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/experiment/earlier_visit.h"

#include <gtest/gtest.h>

#include "core/config/validate.h"
#include "core/util/error.h"

namespace vinebench::harness {
namespace {

sim::SimulationConfig evening() {
  sim::SimulationConfig config;
  config.world.rows = {{{0, 1}, {4, 1}}};
  config.world.sun.elevation_deg = 10;
  config.world.sky.overcast = 0.5;
  config.world.vines.bbch = 89;
  config.route.waypoints.resize(3);
  config.duration = 20;
  return config;
}

TEST(EarlierVisitTest, IsTheSameDriveButForTheNoise) {
  const sim::SimulationConfig earlier = simulation_of({}, evening());
  EXPECT_EQ(earlier.world.sun.elevation_deg, 10);
  EXPECT_EQ(earlier.world.sky.overcast, 0.5);
  EXPECT_EQ(earlier.world.vines.bbch, 89);
  EXPECT_EQ(earlier.route.waypoints.size(), 3u);
  EXPECT_FALSE(earlier.duration);
  EXPECT_EQ(earlier.sensors.camera.noise.pattern, 1);
}

TEST(EarlierVisitTest, HasItsOwnDay) {
  EarlierVisit visit;
  visit.sun.emplace().elevation_deg = 60;
  visit.sky.emplace().overcast = 1;
  visit.bbch = 75;
  visit.waypoints.resize(2);
  visit.duration = 5;
  sim::SimulationConfig config = evening();
  config.sensors.camera.noise.pattern = 7;
  const sim::SimulationConfig earlier = simulation_of(visit, config);
  EXPECT_EQ(earlier.world.sun.elevation_deg, 60);
  EXPECT_EQ(earlier.world.sky.overcast, 1);
  EXPECT_EQ(earlier.world.vines.bbch, 75);
  EXPECT_EQ(earlier.route.waypoints.size(), 2u);
  EXPECT_EQ(earlier.duration, 5);
  EXPECT_EQ(earlier.sensors.camera.noise.pattern, 8);
}

TEST(EarlierVisitTest, AnUnknownGrowthStageIsAnError) {
  EarlierVisit visit;
  visit.bbch = 1;
  EXPECT_THROW(validate(visit), Error);
}

}  // namespace
}  // namespace vinebench::harness
