// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "core/files/files.h"
#include "harness/benchmarks/slam_benchmark.h"
#include "harness/datasets/files/json_file.h"
#include "harness/datasets/reading/dataset_reader.h"
#include "harness/replay.h"
#include "tools/arguments/options.h"
#include "tools/commands/commands.h"
#include "tools/commands/simulation.h"

namespace vinebench::tools {
namespace {

constexpr const char* kRunByDefault = "quick-loop";

struct BenchSlamArguments {
  std::string dataset;
  std::string scenario;
  std::string json;
  std::vector<std::string> overrides;
  int threads = default_threads();
  int frames = 150;
  std::filesystem::path cache;
  bool untrusted = false;
};

void load_recording(const BenchSlamArguments& arguments, harness::SlamBenchmark& benchmark) {
  harness::Recording recording = harness::open_recording(arguments.dataset);
  benchmark.name = recording.name;
  benchmark.rig = recording.rig;
  benchmark.tags = recording.tags;
  benchmark.slam = harness::replay_settings(recording, "", parse_overrides(arguments.overrides));
  WorkerPool pool(arguments.threads);
  harness::DatasetReader reader(std::move(recording), pool);
  benchmark.frames = harness::preload(reader, arguments.frames);
}

int bench_slam(const BenchSlamArguments& arguments, const Surroundings& surroundings) {
  harness::SlamBenchmark benchmark;
  benchmark.threads = arguments.threads;
  if (arguments.dataset.empty()) {
    const std::string scenario = arguments.scenario.empty() ? kRunByDefault : arguments.scenario;
    SimulatedFrames wanted{surroundings.catalogue.find(harness::DataKind::kScenario, scenario),
                           parse_overrides(arguments.overrides), arguments.frames,
                           with_cache(surroundings.machine, arguments.cache)};
    if (arguments.untrusted) wanted.data_folders = surroundings.data_folders;
    simulate_frames(wanted, benchmark);
  } else {
    load_recording(arguments, benchmark);
  }
  const auto result = harness::measure_slam(benchmark);
  fmt::print("{}", harness::slam_table(result));
  if (!arguments.json.empty())
    write_file_atomically(arguments.json, harness::json_text(result, 2) + "\n");
  return 0;
}

}  // namespace

Command bench_slam_command(const Surroundings& surroundings) {
  const auto arguments = std::make_shared<BenchSlamArguments>();
  return {.name = "slam",
          .description =
              "The SLAM core on frames in memory, without rendering: CPU and wall time a frame",
          .options = {{.name = "DATASET",
                       .target = &arguments->dataset,
                       .help = "Recorded data set; the first frames of a scenario where absent",
                       .existing = Existing::kFolder},
                      {.name = "--scenario",
                       .target = &arguments->scenario,
                       .help = "Scenario to simulate (default: quick-loop)",
                       .excludes = "DATASET",
                       .data = harness::DataKind::kScenario},
                      json_option(arguments->json),
                      overrides_option(arguments->overrides,
                                       "Set a key, e.g. slam.features.features=1200"),
                      threads_option(arguments->threads),
                      cache_option(arguments->cache),
                      untrusted_option(arguments->untrusted),
                      {.name = "--frames",
                       .target = &arguments->frames,
                       .help = "Frames at most; they are kept in memory",
                       .show_default = true,
                       .range = Range::between(2, 100000)}},
          .run = [arguments, surroundings] { return bench_slam(*arguments, surroundings); }};
}

}  // namespace vinebench::tools
