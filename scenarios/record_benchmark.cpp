// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "scenarios/record_benchmark.h"

#include <fmt/format.h>

#include <system_error>

#include "scenarios/dataset_writer.h"
#include "scenarios/measurement.h"
#include "scenarios/run_scenario.h"
#include "slam/base/error.h"

namespace vinebench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kSecondsPerHour = 3600;

std::unique_ptr<SimulatedSource> simulate(const RecordBenchmark& benchmark, WorkerPool& pool,
                                          const RecordOptions& options) {
  const Rig rig = load_rig(benchmark.scenario.simulation.rover.rig);
  return make_simulation(benchmark.scenario.simulation,
                         static_cast<std::uint64_t>(benchmark.scenario.seed), default_cache(), pool,
                         plan_of(options, rig));
}

RecordOptions first_frames(const RecordBenchmark& benchmark) {
  RecordOptions options;
  options.last = benchmark.frames - 1;
  options.threads = benchmark.threads;
  options.formats.clear();
  return options;
}

Timing time_alone(const RecordBenchmark& benchmark, const std::vector<std::string>& cameras) {
  WorkerPool pool(benchmark.threads);
  RecordOptions options = first_frames(benchmark);
  options.cameras = cameras;
  const auto source = simulate(benchmark, pool, options);
  return measure([&] {
    while (source->next()) {
    }
  });
}

Json time_recording(const RecordBenchmark& benchmark, const std::vector<std::string>& formats,
                    const std::vector<std::string>& cameras, const Timing& base) {
  WorkerPool pool(benchmark.threads);
  RecordOptions options = first_frames(benchmark);
  options.formats = parse_formats(formats);
  options.cameras = cameras;
  const auto source = simulate(benchmark, pool, options);
  const fs::path folder = benchmark.folder / "recording";
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  DatasetWriter writer(folder, benchmark.scenario, *source, options, source->size());
  std::int64_t images = 0;
  const Timing timing = measure([&] {
    while (const auto sample = source->next()) {
      for (const cv::Mat& image : sample->frame.images) images += image.empty() ? 0 : 1;
      writer.on_tick(*sample, {});
    }
    writer.on_finish({});
  });
  fs::remove_all(folder, ignored);
  const double seconds = timing.wall_ms / 1e3;
  return {{"wall_s", rounded(seconds)},
          {"cpu_s", rounded(timing.cpu_ms / 1e3)},
          {"ratio", rounded(timing.wall_ms / base.wall_ms)},
          {"megabytes", rounded(static_cast<double>(writer.bytes()) / 1e6)},
          {"images_per_hour", rounded(static_cast<double>(images) / seconds * kSecondsPerHour)}};
}

std::vector<std::string> pair_cameras(const Rig& rig) {
  std::vector<std::string> names;
  for (const StereoPair& pair : rig.stereo_pairs) {
    for (const int eye : {pair.left, pair.right}) {
      names.push_back(rig.cameras[static_cast<std::size_t>(eye)].name);
    }
  }
  return names;
}

}  // namespace

Json measure_recording(const RecordBenchmark& benchmark) {
  const std::vector<std::string> pairs =
      pair_cameras(load_rig(benchmark.scenario.simulation.rover.rig));
  if (pairs.empty()) fail("bench record: the scenario's rig has no stereo pair");
  time_alone(benchmark, {});  // grows the plants and warms what keeps things warm
  const Timing base = time_alone(benchmark, {});
  const Timing base_of_pairs = time_alone(benchmark, pairs);
  Json result{{"scenario", benchmark.scenario.name},
              {"frames", benchmark.frames},
              {"threads", benchmark.threads},
              {"base_wall_s", rounded(base.wall_ms / 1e3)},
              {"base_cpu_s", rounded(base.cpu_ms / 1e3)}};
  result["rgb"] = time_recording(benchmark, {"rgb"}, {}, base);
  result["all"] = time_recording(benchmark, all_formats(), {}, base);
  result["training"] = time_recording(benchmark, {"rgb", "depth", "semantic", "instances", "coco"},
                                      pairs, base_of_pairs);
  return result;
}

std::string record_table(const Json& result) {
  std::string text = fmt::format(
      "{}, {} frames, {} threads\n{:<10} {:>8} {:>8} {:>7} {:>9} {:>13}\n",
      result["scenario"].get<std::string>(), result["frames"].get<std::int64_t>(),
      result["threads"].get<int>(), "", "wall s", "CPU s", "ratio", "MB", "images/hour");
  text += fmt::format("{:<10} {:>8.2f} {:>8.2f}\n", "alone", result["base_wall_s"].get<double>(),
                      result["base_cpu_s"].get<double>());
  for (const char* kind : {"rgb", "all", "training"}) {
    const Json& row = result[kind];
    text += fmt::format("{:<10} {:>8.2f} {:>8.2f} {:>7.2f} {:>9.1f} {:>13.0f}\n", kind,
                        row["wall_s"].get<double>(), row["cpu_s"].get<double>(),
                        row["ratio"].get<double>(), row["megabytes"].get<double>(),
                        row["images_per_hour"].get<double>());
  }
  return text;
}

}  // namespace vinebench
