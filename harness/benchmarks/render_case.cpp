// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/benchmarks/render_case.h"

#include <cmath>
#include <numbers>

#include "core/config/override.h"
#include "core/util/error.h"
#include "sim/config_files.h"
#include "sim/world/world_layout.h"

namespace vinebench::harness {
namespace {

constexpr double kBeside = 1.0;     // m from a single row
constexpr double kHalfTrack = 0.2;  // m, half of the rover's track

constexpr int kManyRows = 40;

RenderBenchmark case_of(const RenderSuite& suite, const std::string& file) {
  RenderBenchmark benchmark;
  benchmark.world = sim::load_world(file);
  benchmark.name = benchmark.world.name;
  benchmark.rig = load_rig(suite.rig);
  benchmark.route = aisle_route(benchmark.world, suite.frames);
  benchmark.threads = suite.threads;
  benchmark.mujoco = suite.mujoco && benchmark.name == "csl-vineyard";
  benchmark.images = suite.images;
  benchmark.plant_cache = suite.machine.plant_cache;
  sim::choose_backend(benchmark.renderer, suite.machine.gl_platform);
  return benchmark;
}

/// The large world with many more rows, of which as much is visible.
RenderBenchmark with_many_rows(RenderBenchmark benchmark, const std::string& file) {
  const Override rows = parse_override(fmt::format("block.rows={}", kManyRows));
  benchmark.world = sim::load_world(file, {rows});
  benchmark.name += fmt::format(", {} rows", kManyRows);
  benchmark.route = aisle_route(benchmark.world, static_cast<int>(benchmark.route.size()));
  return benchmark;
}

}  // namespace

std::vector<RenderBenchmark> render_cases(const RenderSuite& suite) {
  std::vector<RenderBenchmark> cases;
  for (const std::string& file : suite.worlds) cases.push_back(case_of(suite, file));
  if (!cases.empty()) return cases;
  cases.push_back(case_of(suite, suite.small_world));
  cases.push_back(case_of(suite, suite.large_world));
  cases.push_back(with_many_rows(cases.back(), suite.large_world));
  return cases;
}

std::vector<Pose> aisle_route(const sim::WorldConfig& world, int count) {
  const sim::WorldLayout layout = sim::lay_out(world);
  const std::size_t middle = layout.rows.size() / 2;
  const sim::RowConfig& last = layout.rows.at(middle);
  sim::RowConfig first = layout.rows.at(middle == 0 ? 0 : middle - 1);
  const Eigen::Vector2d direction = (last.end - last.start).normalized();
  if ((first.end - first.start).dot(direction) < 0) std::swap(first.start, first.end);
  Eigen::Vector2d start = (first.start + last.start) / 2;
  const Eigen::Vector2d along = (first.end + last.end) / 2 - start;
  if (middle == 0) start += kBeside * Eigen::Vector2d(direction.y(), -direction.x());
  const double heading = std::atan2(along.y(), along.x());
  std::vector<Pose> route;
  for (int i = 0; i < count; ++i) {
    const double yaw = heading + (i % 2 == 1 ? std::numbers::pi : 0);
    route.push_back(layout.terrain.lie(start + along * ((i + 0.5) / count), yaw, kHalfTrack));
  }
  return route;
}

}  // namespace vinebench::harness
