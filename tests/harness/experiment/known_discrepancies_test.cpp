// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/experiment/known_discrepancies.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/experiment/scenario.h"

namespace vinebench::harness {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> of_trial(const std::vector<Override>& settings) {
  const auto file = std::filesystem::path(VINEBENCH_SOURCE_DIR) / "scenarios/quick-loop.yaml";
  std::vector<std::string> all;
  for (const Discrepancy& d : trial_of(load_scenario(file, settings)).discrepancies) {
    all.push_back(d.of + ": " + d.what);
  }
  return all;
}

TEST(KnownDiscrepanciesTest, AScenarioWithoutErrorsHasNone) {
  EXPECT_THAT(of_trial({}), IsEmpty());
}

// The right camera's x points to the right: true 2.4 mm farther, told too small.
TEST(KnownDiscrepanciesTest, CalibrationSurveyAndInstants) {
  EXPECT_EQ(
      of_trial({{"sensors.calibration.cameras", "[{name: back_right, position: [0.0024, 0, 0]}]"}})
          .at(0),
      "back pair: baseline");
  EXPECT_THAT(of_trial({{"world.tags.0.survey_error.offset", "[0.06, 0, 0]"}}),
              ElementsAre("tag 0: position"));
  EXPECT_THAT(of_trial({{"sensors.timing.triggers",
                         "[{camera: back_left, delay: 0.01}, {camera: back_right, delay: 0.01}]"}}),
              ElementsAre("back pair: exposure"));
  EXPECT_THAT(of_trial({{"sensors.timing.triggers", "[{camera: back_left, delay: 0.01}]"}}),
              ElementsAre("back_left: exposure"));
  EXPECT_THAT(of_trial({{"sensors.timing.stamp_offset", "0.03"}}),
              ElementsAre("all cameras: stamps"));
}

// 5 % of 263 px are 13 px; the rover's wheels have a radius of 0.1 m.
TEST(KnownDiscrepanciesTest, Wheels) {
  EXPECT_THAT(of_trial({{"slam.dead_reckoning.wheels.radius", "0.105"}}),
              ElementsAre("wheels: radius"));
}

}  // namespace
}  // namespace vinebench::harness
