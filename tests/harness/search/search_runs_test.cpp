// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/search/search_runs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/sweep/run_cost_estimate.h"
#include "tests/support/fake_search.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using test::FakeSearch;
using testing::HasSubstr;

double good(const ScenarioConfig&, std::int64_t) {
  return 0.01;
}

TEST(SearchRunsTest, EachIsMadeOnce) {
  FakeSearch fake(good);
  SearchRuns runs = fake.runs();
  const Query query{{{0.5, 0, 0}}};
  EXPECT_EQ(runs.ask(query).verdict, RunVerdict::kPassed);
  runs.ask({query, query, {{{0.5, 0, 0}}, Role::kSystem, 2}});
  EXPECT_EQ(fake.made, 2);  // the second seed is another
  EXPECT_EQ(runs.count(), 2u);
}

// 45 and 45.02 degrees are 45 both, in a file of four digits.
TEST(SearchRunsTest, TheSameScenarioIsTheSameRun) {
  FakeSearch fake(good);
  fake.problem.space.difficulties[1].between["world.sun.elevation_deg"] = {45, 45.0001};
  SearchRuns runs = fake.runs();
  runs.ask({Query{{{0, 0.25, 0}}}, Query{{{0, 0.75, 0}}}});
  EXPECT_EQ(fake.made, 1);
}

TEST(SearchRunsTest, BeyondTheBudgetNothingIsKnown) {
  FakeSearch fake(good);
  SearchRuns runs = fake.runs(1);
  const auto answers = runs.ask({Query{{{0.5, 0, 0}}}, Query{{{1, 0, 0}}}});
  EXPECT_EQ(answers[0].verdict, RunVerdict::kPassed);
  EXPECT_EQ(answers[1].verdict, RunVerdict::kUnknown);
  EXPECT_EQ(runs.left(), 0u);
}

TEST(SearchRunsTest, WhatCannotBeSimulatedIsAnAnswerAndCostsNothing) {
  FakeSearch fake(good);
  fake.problem.space.difficulties[0].between["route.speed"] = {0.5, -1};
  SearchRuns runs = fake.runs();
  const Answer answer = runs.ask({{{1, 0, 0}}});
  EXPECT_EQ(answer.verdict, RunVerdict::kImpossible);
  EXPECT_THAT(answer.why, HasSubstr("route.speed"));
  EXPECT_EQ(fake.made, 0);
  EXPECT_THAT(
      test::error_of([&] { check_problem(fake.problem); }),
      testing::AllOf(HasSubstr("difficulty 'speed', severity 1"), HasSubstr("route.speed")));
}

TEST(SearchRunsTest, TellsWhichDifficultyBeginsElsewhere) {
  FakeSearch fake(good);
  EXPECT_THAT(jumps_of(fake.problem), testing::IsEmpty());
  fake.problem.space.difficulties[1].between["world.sun.elevation_deg"] = {40, 4};
  EXPECT_THAT(jumps_of(fake.problem), testing::ElementsAre("sun"));
}

TEST(SearchRunsTest, ABoundMustBeOneOfTheScenarios) {
  FakeSearch fake(good);
  fake.problem.bound = "drift_max";
  EXPECT_THAT(test::error_of([&] { check_problem(fake.problem); }), HasSubstr("drift_max"));
}

TEST(SearchRunsTest, TheRouteIsCutAtWaypoints) {
  FakeSearch fake(good);
  const ScenarioConfig cut = scenario_of(fake.problem, {{0, 0, 0}, {1, 3, 2.0}}, Role::kSystem);
  ASSERT_EQ(cut.simulation.route.waypoints.size(), 3u);
  EXPECT_EQ(cut.simulation.route.waypoints[0].position.x(), 1.5);
  EXPECT_EQ(drive_duration(cut), 2);
  EXPECT_FALSE(cut.guard);
}

}  // namespace
}  // namespace vinebench::harness
