// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/benchmarks/render_benchmark.h"

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "core/util/worker_pool.h"
#include "harness/benchmarks/measurement.h"
#include "harness/benchmarks/mujoco_benchmark.h"
#include "harness/datasets/files/image_file.h"
#include "harness/datasets/files/json_file.h"
#include "harness/sets/child_process.h"
#include "sim/render/gl/gl_renderer.h"
#include "sim/world/world_layout.h"

namespace vinebench::harness {
namespace {

using Json = nlohmann::ordered_json;

/// Mesa reads these once per process. With one thread, Mesa uses no worker threads.
void prepare_software_rendering(int threads) {
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  setenv("LP_NUM_THREADS", std::to_string(threads == 1 ? 0 : threads).c_str(), 1);
}

Json measure_camera(sim::GlRenderer& renderer, const RigCamera& camera,
                    const RenderBenchmark& benchmark) {
  const Pose& first = benchmark.route.front();
  const RenderedImage image =
      renderer.render(camera.model, first * camera.T_body_cam, {});  // warm up
  if (!benchmark.images.empty()) {
    write_image(benchmark.images / fmt::format("{}.png", camera.name), image.rgb);
  }
  std::vector<Timing> timings;
  for (const Pose& T_world_body : benchmark.route) {
    timings.push_back(
        measure([&] { renderer.render(camera.model, T_world_body * camera.T_body_cam, {}); }));
  }
  const Timing typical = median(timings);
  return {{"camera", camera.name},
          {"pixels", fmt::format("{} x {}", camera.model.width, camera.model.height)},
          {"cpu_ms", rounded(typical.cpu_ms)},
          {"wall_ms", rounded(typical.wall_ms)}};
}

void render_frame(WorkerPool& pool, std::vector<sim::GlRenderer>& renderers, const Rig& rig,
                  const Pose& T_world_body) {
  std::atomic<std::size_t> next{0};
  pool.for_each(renderers.size(), [&](std::size_t lane) {
    for (std::size_t i = next++; i < rig.cameras.size(); i = next++) {
      const RigCamera& camera = rig.cameras[rig.cameras.size() - 1 - i];  // the largest first
      renderers[lane].render(camera.model, T_world_body * camera.T_body_cam, {});
    }
  });
}

double measure_frames(std::vector<sim::GlRenderer>& renderers, const RenderBenchmark& benchmark) {
  WorkerPool pool(static_cast<int>(renderers.size()));
  render_frame(pool, renderers, benchmark.rig, benchmark.route.front());  // warm up
  std::vector<double> wall;
  for (const Pose& T_world_body : benchmark.route) {
    const Timing timing =
        measure([&] { render_frame(pool, renderers, benchmark.rig, T_world_body); });
    wall.push_back(timing.wall_ms);
  }
  return rounded(median(std::move(wall)));
}

/// In its own process.
Json measure_with_threads(const RenderBenchmark& benchmark, int threads) {
  prepare_software_rendering(threads);
  std::optional<sim::Scene> scene;
  const Timing built = measure(
      [&] { scene = sim::build_scene(benchmark.world, benchmark.seed, benchmark.plant_cache); });
  std::vector<sim::GlRenderer> renderers;
  const Timing uploaded = measure([&] {
    for (int i = 0; i < threads; ++i) renderers.emplace_back(*scene, benchmark.renderer);
  });
  Json result;
  for (const RigCamera& camera : benchmark.rig.cameras) {
    if (threads > 1) break;
    result["cameras"].push_back(measure_camera(renderers[0], camera, benchmark));
  }
  result["plants"] = sim::lay_out(benchmark.world).vines.size();
  result["frame_wall_ms"] = measure_frames(renderers, benchmark);
  result["build_s"] = rounded(built.wall_ms / 1e3);
  result["upload_s"] = rounded(uploaded.wall_ms / 1e3);
  result["memory_mib"] = std::round(peak_memory_mib());
  return result;
}

Json in_child(const RenderBenchmark& benchmark, const std::function<Json()>& job) {
  return Json::parse(run_in_child(benchmark.name, [&] { return json_text(job()); }));
}

}  // namespace

Json measure_rendering(const RenderBenchmark& benchmark) {
  const Json one = in_child(benchmark, [&] { return measure_with_threads(benchmark, 1); });
  Json all = one;
  if (benchmark.threads > 1) {
    all = in_child(benchmark, [&] { return measure_with_threads(benchmark, benchmark.threads); });
  }
  Json result{{"name", benchmark.name},
              {"rows", sim::lay_out(benchmark.world).rows.size()},
              {"plants", one["plants"]},
              {"cameras", one["cameras"]}};
  result["frame_wall_ms"]["1"] = one["frame_wall_ms"];
  result["frame_wall_ms"][std::to_string(benchmark.threads)] = all["frame_wall_ms"];
  result["scaling"] =
      rounded(one["frame_wall_ms"].get<double>() / all["frame_wall_ms"].get<double>());
  for (const char* key : {"memory_mib", "build_s", "upload_s"}) result[key] = all[key];
  if (!benchmark.mujoco) return result;
  result["mujoco"] = in_child(benchmark, [&] {
    prepare_software_rendering(1);
    return measure_mujoco(benchmark);
  });
  compare_with_mujoco(result["mujoco"], result["cameras"]);
  return result;
}

}  // namespace vinebench::harness
