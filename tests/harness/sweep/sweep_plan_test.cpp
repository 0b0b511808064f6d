// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sweep/sweep_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/support/fake_sweep.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using test::error_of;
using testing::HasSubstr;

class SweepPlanTest : public testing::Test {
 protected:
  SweepPlan reread(const std::string& text) const {
    return read_plan(folder_.write("plan.jsonl", text));
  }
  std::string error_of_text(const std::string& text) const {
    return error_of([&] { reread(text); });
  }

  test::TestFolder folder_;
};

TEST_F(SweepPlanTest, HasATaskForEveryRun) {
  const SweepPlan plan = test::fake_plan(2);
  ASSERT_EQ(plan.cells.size(), 4u);
  ASSERT_EQ(plan.tasks.size(), 4u * 3u * 2u);
  EXPECT_EQ(plan.tasks[0].folder, "speed=1/row/seed-1");
  EXPECT_EQ(plan.tasks[1].folder, "speed=1/row/seed-1/repeat-2");
  EXPECT_EQ(plan.tasks[2].seed, 2);
  EXPECT_EQ(plan.tasks[6].folder, "speed=2/row/seed-1");
  EXPECT_EQ(plan.tasks[12].cost, 3);
  std::set<std::string> keys;
  for (const SweepTask& task : plan.tasks) keys.insert(task.key);
  EXPECT_EQ(keys.size(), 12u);  // repeats have the same inputs
  EXPECT_EQ(plan.tasks[0].key, plan.tasks[1].key);
}

TEST_F(SweepPlanTest, AFileHoldsAllOfIt) {
  const SweepPlan plan = test::fake_plan(2);
  const std::string text = format_plan(plan);
  EXPECT_EQ(std::ranges::count(text, '\n'), 25);
  const SweepPlan again = reread(text);
  EXPECT_EQ(again.build, plan.build);
  EXPECT_EQ(again.cells, plan.cells);
  EXPECT_EQ(format_plan(again), text);
}

TEST_F(SweepPlanTest, WhatIsNoPlanIsRefused) {
  const std::string text = format_plan(test::fake_plan());
  EXPECT_THAT(error_of_text(""), HasSubstr("is empty"));
  EXPECT_THAT(error_of_text("{}\n"), HasSubstr("plan.jsonl:1: expected a line of a plan"));
  EXPECT_THAT(error_of_text(text.substr(0, text.size() / 2)),
              HasSubstr("expected a line of a plan"));
  const std::size_t last = text.rfind('\n', text.size() - 2);
  EXPECT_THAT(error_of_text(text.substr(0, last + 1)), HasSubstr("expected 12 tasks, found 11"));
  std::string other = text;
  other.replace(other.find("\"sweep_plan\":1"), 14, "\"sweep_plan\":9");
  EXPECT_THAT(error_of_text(other), HasSubstr("plan.jsonl:1: expected format 1, found 9"));
  for (const char* folder : {"/etc", "../x", "a/../../b", ".", ""}) {
    std::string escaping = text;
    const std::string inside = "speed=1/row/seed-1";
    escaping.replace(escaping.find(inside), inside.size(), folder);
    EXPECT_THAT(error_of_text(escaping), HasSubstr("plan.jsonl:2: folder: ")) << folder;
  }
}

TEST_F(SweepPlanTest, ScenariosOfOneNameAreRefused) {
  SweepSpec spec;
  spec.scenarios = {"row", "row.yaml"};
  const auto make = [&] { make_plan(spec, test::load_fake, [](const auto&) { return 1.0; }); };
  EXPECT_THAT(error_of(make), HasSubstr("row and row.yaml have the same name 'row'"));
  spec.scenarios = {"row"};
  spec.set = {{"bad", "1"}};
  EXPECT_THAT(error_of(make), HasSubstr("row: bad: unknown key"));
}

TEST_F(SweepPlanTest, RunsHaveTheirSettings) {
  const SweepPlan plan = test::fake_plan();
  const auto runs = planned_runs(plan, {4, 0, 3}, test::load_fake, "out");
  ASSERT_EQ(runs.size(), 3u);
  EXPECT_EQ(runs[0].title, "row, speed=2");
  EXPECT_EQ(runs[0].scenario().seed, 2);
  EXPECT_EQ(runs[0].scenario().simulation.duration, 2.0);
  EXPECT_EQ(runs[1].folder, "out/speed=1/row/seed-1");
  EXPECT_EQ(runs[0].settings, runs[2].settings);  // shared
}

TEST_F(SweepPlanTest, AnotherBuildDoesNotRunIt) {
  SweepPlan plan = test::fake_plan();
  plan.build.program = "0";
  EXPECT_THAT(error_of([&] { planned_runs(plan, {0}, test::load_fake, "out"); }),
              HasSubstr("another build of the program"));
}

TEST_F(SweepPlanTest, AChangedScenarioIsNotRun) {
  const SweepPlan plan = test::fake_plan();
  const auto changed = [](const std::string& name, const std::vector<Override>& overrides) {
    ScenarioConfig scenario = test::load_fake(name, overrides);
    scenario.expectations.coverage_min = 0.5;
    return scenario;
  };
  EXPECT_THAT(error_of([&] { planned_runs(plan, {1}, changed, "out"); }),
              HasSubstr("row, speed=1, seed 2: is not what it was"));
}

}  // namespace
}  // namespace vinebench::harness
