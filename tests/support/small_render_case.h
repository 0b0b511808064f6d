// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/benchmarks/render_case.h"
#include "sim/config_files.h"
#include "tests/support/mesh_world.h"

namespace vinebench::test {

/// One pose in the world of write_mesh_world(), and two small cameras of one size with a third of
/// another.
inline harness::RenderBenchmark small_render_case(const TestFolder& folder) {
  harness::RenderBenchmark benchmark;
  benchmark.name = "triangles";
  benchmark.world = sim::load_world(write_mesh_world(folder));
  for (const auto& [name, width] : {std::pair("left", 24), {"right", 24}, {"side", 32}}) {
    const PinholeCamera model{
        .width = width, .height = 16, .fx = 20, .fy = 20, .cx = (width - 1) / 2.0, .cy = 7.5};
    benchmark.rig.cameras.push_back({name, model, Rig::mount({0, 0, 0.5}, {0, 0, 0})});
  }
  benchmark.route = {{exp_so3({0, 0, 1.5}), {0, 0, 0}}};
  benchmark.renderer.shadow_map_size = 0;
  return benchmark;
}

}  // namespace vinebench::test
