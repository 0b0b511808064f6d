// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sweep/run_cost_estimate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

const std::filesystem::path kScenario =
    std::filesystem::path(VINEBENCH_SOURCE_DIR) / "scenarios/aisle-loop.yaml";

// Beside the start, every two seconds of the drive cost the same.
TEST(RunCostEstimateTest, GrowsWithTheFrames) {
  ScenarioConfig scenario = load_scenario(kScenario);
  scenario.simulation.duration = 2;
  const double short_run = estimate_cost(scenario);
  scenario.simulation.duration = 4;
  const double longer = estimate_cost(scenario);
  scenario.simulation.duration = 6;
  EXPECT_NEAR(estimate_cost(scenario) - longer, longer - short_run, 1e-9);
  EXPECT_GT(longer, short_run);
  scenario.simulation.duration = 1e6;  // the route ends before
  EXPECT_LT(estimate_cost(scenario), 1e4);
}

TEST(RunCostEstimateTest, MeasuredOnesAreMedians) {
  const test::TestFolder folder;
  for (const auto& [seed, cost] : {std::pair(1, 10), {2, 40}, {3, 30}}) {
    const std::string name = "row/seed-" + std::to_string(seed);
    std::filesystem::create_directories(folder / name);
    folder.write(
        name + "/metrics.json",
        fmt::format(R"({{"scenario": "row", "seed": {}, "cpu_seconds": {}}})", seed, cost));
  }
  EXPECT_THAT(measured_costs(folder.path()), testing::ElementsAre(testing::Pair("row", 30)));
}

}  // namespace
}  // namespace vinebench::harness
