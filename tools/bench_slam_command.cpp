// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <thread>

#include "core/util/files.h"
#include "harness/benchmarks/slam_benchmark.h"
#include "harness/datasets/reading/dataset_reader.h"
#include "harness/replay.h"
#include "tools/commands.h"
#include "tools/interactive.h"
#include "tools/simulation.h"

namespace vinebench::tools {
namespace {

struct BenchSlamArguments {
  std::string dataset;
  std::string scenario;
  std::string json;
  std::vector<std::string> overrides;
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  int frames = 150;
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

int bench_slam(const BenchSlamArguments& arguments) {
  harness::SlamBenchmark benchmark;
  benchmark.threads = arguments.threads;
  if (arguments.dataset.empty()) {
    simulate_frames({arguments.scenario, parse_overrides(arguments.overrides), arguments.frames},
                    benchmark);
  } else {
    load_recording(arguments, benchmark);
  }
  const auto result = harness::measure_slam(benchmark);
  fmt::print("{}", harness::slam_table(result));
  if (!arguments.json.empty()) write_file_atomically(arguments.json, result.dump(2) + "\n");
  return 0;
}

}  // namespace

void add_bench_slam(CLI::App& bench, Command& chosen) {
  const auto arguments = std::make_shared<BenchSlamArguments>();
  CLI::App* slam = bench.add_subcommand(
      "slam", "The SLAM core on frames in memory, without rendering: CPU and wall time a frame");
  auto* dataset =
      slam->add_option("DATASET", arguments->dataset,
                       "Recorded data set; the first frames of a scenario where absent");
  slam->add_option("--scenario", arguments->scenario,
                   "Scenario to simulate (default: scenarios/quick-loop.yaml)")
      ->excludes(dataset);
  slam->add_option("--json", arguments->json, "Also write the results to this file");
  slam->add_option("--set", arguments->overrides, "Set a key, e.g. slam.features.features=1200")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  slam->add_option("--threads", arguments->threads, "Threads")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  slam->add_option("--frames", arguments->frames, "Frames at most; they are kept in memory")
      ->check(CLI::Range(2, 100000))
      ->capture_default_str();
  slam->callback([&chosen, arguments] { chosen = [arguments] { return bench_slam(*arguments); }; });
}

}  // namespace vinebench::tools
