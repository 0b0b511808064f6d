// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/benchmarks/render_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vinebench::harness {
namespace {

using testing::HasSubstr;

TEST(RenderTableTest, NamesEveryFigure) {
  const auto world = nlohmann::ordered_json::parse(R"({
    "name": "small", "rows": 3, "plants": 12,
    "cameras": [{"camera": "side", "pixels": "64 x 48", "cpu_ms": 12.34, "wall_ms": 11.1}],
    "frame_wall_ms": {"1": 80.0, "2": 40.0}, "scaling": 2.0,
    "memory_mib": 321, "build_s": 1.5, "upload_s": 0.5,
    "mujoco": {"platform": "EGL", "images": [{"camera": "side", "pixels": "64 x 48",
      "meshes": "finest", "shadows": false, "triangles": 1000, "cpu_ms": 123.4,
      "wall_ms": 100.0, "throughput_ratio": 10.0}]}})");
  const std::string table = render_table(world);
  EXPECT_THAT(table, HasSubstr("small: 3 rows, 12 plants\n"));
  EXPECT_THAT(table, HasSubstr("side               64 x 48      12.3      11.1\n"));
  EXPECT_THAT(table, HasSubstr("80.0 ms wall with 1 thread, 40.0 ms wall with 2 threads, x 2.00"));
  EXPECT_THAT(table, HasSubstr("321 MiB"));
  EXPECT_THAT(table, HasSubstr("123.4     100.0    finest       no       1000     10.0\n"));
}

}  // namespace
}  // namespace vinebench::harness
