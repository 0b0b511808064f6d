// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/benchmarks/mujoco_benchmark.h"

#include <gtest/gtest.h>

#include "tests/support/small_render_case.h"

namespace vinebench::harness {
namespace {

using Json = nlohmann::ordered_json;

TEST(MujocoBenchmarkTest, MeasuresThreeVariantsOfEachImageSize) {
  const test::TestFolder folder;
  RenderBenchmark benchmark = test::small_render_case(folder);
  benchmark.rig.cameras.pop_back();  // the side camera; left and right have the same size
  benchmark.images = folder.path();
  benchmark.plant_cache = folder / "cache";
  const Json result = measure_mujoco(benchmark);
  ASSERT_EQ(result["images"].size(), 3u);
  EXPECT_EQ(result["images"][0]["camera"], "left");
  EXPECT_EQ(result["images"][0]["pixels"], "24 x 16");
  EXPECT_EQ(result["images"][0]["shadows"], false);
  EXPECT_EQ(result["images"][1]["meshes"], "at 2 m");
  EXPECT_EQ(result["images"][2]["shadows"], true);
  for (const Json& image : result["images"]) {
    EXPECT_GT(image["wall_ms"], 0);
    EXPECT_GT(image["triangles"], 2);  // the two vines and the ground
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "left-mujoco-shadows.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "right-mujoco-finest.png"));
}

TEST(MujocoBenchmarkTest, ComparesCpuTimesOfTheSameCamera) {
  Json mujoco{
      {"images", {{{"camera", "side"}, {"cpu_ms", 30.0}}, {{"camera", "top"}, {"cpu_ms", 1.0}}}}};
  compare_with_mujoco(
      mujoco, {{{"camera", "left"}, {"cpu_ms", 5.0}}, {{"camera", "side"}, {"cpu_ms", 12.0}}});
  EXPECT_EQ(mujoco["images"][0]["throughput_ratio"], 2.5);  // 30 / 12
  EXPECT_FALSE(mujoco["images"][1].contains("throughput_ratio"));
}

}  // namespace
}  // namespace vinebench::harness
