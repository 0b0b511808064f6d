// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/benchmarks/simulated_frames.h"

#include "tests/support/court_scenario.h"

namespace vinebench::harness {
namespace {

using SimulatedFramesTest = test::CourtScenario;

TEST_F(SimulatedFramesTest, FillTheBenchmark) {
  ScenarioConfig court = scenario();
  court.slam.tracking.radius = 12;
  SlamBenchmark benchmark;
  load_simulated_frames(court, machine(), 4, benchmark);
  EXPECT_EQ(benchmark.name, "court");
  EXPECT_EQ(benchmark.slam.tracking.radius, 12);
  EXPECT_EQ(benchmark.rig.cameras.size(), 2u);
  ASSERT_EQ(benchmark.tags.size(), 1u);
  EXPECT_EQ(benchmark.tags[0].id, 3);
  ASSERT_EQ(benchmark.frames.size(), 4u);
  EXPECT_EQ(benchmark.frames[3].images.at(1).type(), CV_8UC1);
}

}  // namespace
}  // namespace vinebench::harness
