// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "scenarios/render_benchmark.h"

#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <ctime>
#include <numbers>

#include "scenarios/run_scenario.h"
#include "sim/renderer.h"
#include "slam/base/worker_pool.h"

namespace vinebench {
namespace {

double wall_ms() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::milli>(now).count();
}

/// CPU time of all threads of the process.
double cpu_ms() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double rounded(double value) {
  return std::round(100 * value) / 100;
}

double peak_memory_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

nlohmann::ordered_json measure_camera(Renderer& renderer, const RigCamera& camera,
                                      const std::vector<Pose>& route) {
  std::vector<double> cpu;
  std::vector<double> wall;
  for (const Pose& T_world_body : route) {
    const double cpu_start = cpu_ms();
    const double wall_start = wall_ms();
    renderer.render(camera.model, T_world_body * camera.T_body_cam, {});
    cpu.push_back(cpu_ms() - cpu_start);
    wall.push_back(wall_ms() - wall_start);
  }
  return {{"camera", camera.name},
          {"pixels", fmt::format("{} x {}", camera.model.width, camera.model.height)},
          {"cpu_ms", rounded(median(cpu))},
          {"wall_ms", rounded(median(wall))}};
}

std::vector<double> measure_frames(std::vector<Renderer>& renderers, const Rig& rig,
                                   const std::vector<Pose>& route) {
  WorkerPool pool(static_cast<int>(renderers.size()));
  std::vector<double> wall;
  for (const Pose& T_world_body : route) {
    const double start = wall_ms();
    std::atomic<std::size_t> next{0};
    pool.for_each(renderers.size(), [&](std::size_t lane) {
      for (std::size_t i = next++; i < rig.cameras.size(); i = next++) {
        const RigCamera& camera = rig.cameras[rig.cameras.size() - 1 - i];  // the largest first
        renderers[lane].render(camera.model, T_world_body * camera.T_body_cam, {});
      }
    });
    wall.push_back(wall_ms() - start);
  }
  return wall;
}

}  // namespace

std::vector<Pose> aisle_route(const WorldConfig& world, int count) {
  const WorldConfig::Row& first = world.rows.at(0);
  const WorldConfig::Row& second = world.rows.at(world.rows.size() > 1 ? 1 : 0);
  const Eigen::Vector2d start = (first.start + second.start) / 2;
  const Eigen::Vector2d along = (first.end + second.end) / 2 - start;
  const double heading = std::atan2(along.y(), along.x());
  std::vector<Pose> route;
  for (int i = 0; i < count; ++i) {
    const bool back = i % 2 == 1;
    const Eigen::Vector2d at = start + along * ((i + 0.5) / count);
    route.push_back({from_roll_pitch_yaw({0, 0, heading + (back ? std::numbers::pi : 0)}),
                     {at.x(), at.y(), 0}});
  }
  return route;
}

nlohmann::ordered_json measure_rendering(const RenderBenchmark& benchmark, int threads) {
  const double start = wall_ms();
  const Scene scene = build_scene(benchmark.world, benchmark.seed, default_cache());
  const double built = wall_ms();
  std::vector<Renderer> renderers;
  for (int i = 0; i < threads; ++i) renderers.emplace_back(scene, RendererConfig{});
  const double uploaded = wall_ms();
  nlohmann::ordered_json result{{"name", benchmark.name}, {"threads", threads}};
  for (const RigCamera& camera : benchmark.rig.cameras) {
    renderers[0].render(camera.model, benchmark.route.front() * camera.T_body_cam, {});  // warm up
    result["cameras"].push_back(measure_camera(renderers[0], camera, benchmark.route));
  }
  measure_frames(renderers, benchmark.rig, {benchmark.route.front()});
  result["frame_wall_ms"] =
      rounded(median(measure_frames(renderers, benchmark.rig, benchmark.route)));
  result["build_s"] = rounded((built - start) / 1e3);
  result["upload_s"] = rounded((uploaded - built) / 1e3);
  result["memory_mib"] = std::round(peak_memory_mib());
  return result;
}

}  // namespace vinebench
