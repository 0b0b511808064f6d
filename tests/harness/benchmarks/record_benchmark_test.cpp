// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/benchmarks/record_benchmark.h"

#include <gmock/gmock.h>

#include "tests/support/small_scenario.h"

namespace vinebench::harness {
namespace {

using RecordBenchmarkTest = test::SmallScenario;

TEST_F(RecordBenchmarkTest, TellsWhatEachKindOfRecordingCosts) {
  RecordBenchmark benchmark;
  benchmark.scenario = load_scenario(request_.scenario);
  benchmark.frames = 2;
  benchmark.rounds = 2;
  benchmark.plant_cache = request_.machine.plant_cache;
  benchmark.folder = folder_ / "bench";
  const auto result = measure_recording(benchmark);
  const auto& rows = result["rows"];
  for (const char* kind :
       {"record rgb", "record labels", "record training", "run rgb", "run labels"}) {
    EXPECT_GT(rows[kind]["wall_s"], 0) << kind;
    EXPECT_GT(rows[kind]["images_per_hour"], 0) << kind;
  }
  for (const char* base : {"record", "run"}) {
    EXPECT_EQ(rows[base]["ratio"], 1);
    EXPECT_EQ(rows[base]["megabytes"], 0);
  }
  EXPECT_GT(rows["record labels"]["megabytes"], rows["record rgb"]["megabytes"]);
  EXPECT_EQ(rows["run rgb"]["megabytes"], rows["record rgb"]["megabytes"]);
  EXPECT_FALSE(std::filesystem::exists(benchmark.folder / "recording"));
  EXPECT_THAT(record_table(result), testing::HasSubstr("2 threads, 2 rounds"));
  EXPECT_THAT(record_table(result), testing::HasSubstr("record training"));
  EXPECT_FALSE(rows.contains("pairs"));
}

}  // namespace
}  // namespace vinebench::harness
