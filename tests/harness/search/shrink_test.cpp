// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/search/shrink.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "tests/support/fake_search.h"

namespace vinebench::harness {
namespace {

using test::FakeSearch;

/// The waypoint where the rover turns in place.
bool turns(const ScenarioConfig& scenario) {
  return std::ranges::any_of(scenario.simulation.route.waypoints,
                             [](const auto& waypoint) { return waypoint.heading_deg == 50; });
}

Condition shrunk(FakeSearch& fake, const Condition& condition) {
  SearchRuns runs = fake.runs();
  return shrink(runs, condition, {1, 2, 3}, test::tell_nobody).back();
}

TEST(ShrinkTest, DropsDifficultiesAndWhatTheRouteDoesNotNeed) {
  const auto system = [](const ScenarioConfig& scenario, std::int64_t) {
    return test::speed_of(scenario) > 0.9 && turns(scenario) ? test::kBadError : test::kGoodError;
  };
  FakeSearch fake(system);
  const Condition small = shrunk(fake, {{0.75, 1, 0.5}});
  EXPECT_EQ(small.severities, (Severities{0.75, 0, 0}));
  // The turn is at the fourth of seven waypoints: it ends there, and begins one before.
  EXPECT_EQ(small.cut.last, 3u);
  EXPECT_EQ(small.cut.first, 2u);
  EXPECT_TRUE(small.cut.duration);
}

// The first seed fails from a half on, the third from 5/8.
TEST(ShrinkTest, GrowsUntilAllSeedsAgree) {
  FakeSearch fake([](const ScenarioConfig& scenario, std::int64_t seed) {
    const double least = seed == 3 ? 1.0 : 0.9;
    return test::speed_of(scenario) > least ? test::kBadError : test::kGoodError;
  });
  const Condition small = shrunk(fake, {{0.53125, 0, 0}});
  EXPECT_GT(small.severities[0], 0.625);
  EXPECT_LT(small.severities[0], 0.75);
}

// On a route without the way back the loop cannot be closed, whatever the conditions.
TEST(ShrinkTest, ARouteOnWhichItCannotPassIsNone) {
  FakeSearch fake([](const ScenarioConfig& scenario, std::int64_t) {
    const auto& [route, duration] =
        std::tie(scenario.simulation.route, scenario.simulation.duration);
    const bool whole = route.waypoints.size() == 7 && !duration;
    return test::speed_of(scenario) > 0.9 || !whole ? test::kBadError : test::kGoodError;
  });
  EXPECT_EQ(shrunk(fake, {{0.75, 0, 0}}).cut, RouteCut{});
}

TEST(ShrinkTest, HarderStaysAtTheWorst) {
  EXPECT_EQ(harder({{0.5, 1, 0}}).severities, (Severities{0.5625, 1, 0}));
}

}  // namespace
}  // namespace vinebench::harness
