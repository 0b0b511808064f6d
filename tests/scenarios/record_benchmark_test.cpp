// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "scenarios/record_benchmark.h"

#include <gmock/gmock.h>

#include "tests/scenarios/small_scenario.h"

namespace vinebench {
namespace {

using RecordBenchmarkTest = test::SmallScenario;

TEST_F(RecordBenchmarkTest, TellsWhatEachKindOfRecordingCosts) {
  RecordBenchmark benchmark;
  benchmark.scenario = load_scenario(request_.scenario);
  benchmark.frames = 3;
  benchmark.folder = folder_ / "bench";
  const auto result = measure_recording(benchmark);
  for (const char* kind : {"rgb", "all", "training"}) {
    EXPECT_GT(result[kind]["wall_s"], 0) << kind;
    EXPECT_GT(result[kind]["images_per_hour"], 0) << kind;
  }
  EXPECT_GT(result["all"]["megabytes"], result["rgb"]["megabytes"]);
  EXPECT_FALSE(std::filesystem::exists(benchmark.folder / "recording"));
  EXPECT_THAT(record_table(result), testing::HasSubstr("training"));
}

}  // namespace
}  // namespace vinebench
