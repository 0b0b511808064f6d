// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/benchmarks/render_benchmark.h"

#include <gtest/gtest.h>

#include "tests/support/small_render_case.h"

namespace vinebench::harness {
namespace {

// Suites of this name run first: Mesa's threads, which other tests start, do not survive a fork.
TEST(RenderBenchmarkDeathTest, MeasuresImagesAloneAndFramesWithThreads) {
  const test::TestFolder folder;
  RenderBenchmark benchmark = test::small_render_case(folder);
  benchmark.threads = 2;
  benchmark.images = folder.path();
  benchmark.plant_cache = folder / "cache";
  const nlohmann::ordered_json result = measure_rendering(benchmark);
  EXPECT_EQ(result["name"], "triangles");
  EXPECT_EQ(result["rows"], 1);
  EXPECT_EQ(result["plants"], 2);
  ASSERT_EQ(result["cameras"].size(), 3u);
  EXPECT_EQ(result["cameras"][2]["pixels"], "32 x 16");
  EXPECT_GT(result["cameras"][2]["wall_ms"], 0);
  EXPECT_GT(result["frame_wall_ms"]["1"], 0);
  EXPECT_GT(result["frame_wall_ms"]["2"], 0);
  EXPECT_GT(result["memory_mib"], 1);
  EXPECT_FALSE(result.contains("mujoco"));
  EXPECT_TRUE(std::filesystem::exists(folder / "side.png"));
}

}  // namespace
}  // namespace vinebench::harness
