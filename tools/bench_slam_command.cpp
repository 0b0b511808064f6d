// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <thread>

#include "core/util/error.h"
#include "core/util/files.h"
#include "harness/benchmarks/slam_benchmark.h"
#include "harness/jobs/run_scenario.h"
#include "harness/replay.h"
#include "tools/commands.h"
#include "tools/gl_variable.h"
#include "tools/interactive.h"

namespace vinebench::tools {
namespace {

constexpr const char* kDefaultScenario = "scenarios/quick-loop.yaml";

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
  benchmark.frames = harness::preload(*harness::play(std::move(recording), pool), arguments.frames);
}

void record_simulation(const BenchSlamArguments& arguments, harness::SlamBenchmark& benchmark) {
  const std::string file = arguments.scenario.empty() ? kDefaultScenario : arguments.scenario;
  if (arguments.scenario.empty() && !std::filesystem::exists(file)) {
    fail(
        "bench slam: no {} here; run it in the project's folder, or name a DATASET or a --scenario",
        file);
  }
  harness::ScenarioConfig scenario =
      harness::load_scenario(file, parse_overrides(arguments.overrides));
  sim::choose_backend(scenario.simulation.renderer, gl_variable());
  fmt::print(stderr, "simulating at most {} frames of {} …\n", arguments.frames, scenario.name);
  WorkerPool pool(arguments.threads);
  const auto source =
      sim::make_simulation(scenario.simulation, static_cast<std::uint64_t>(scenario.seed),
                           harness::default_cache(), pool);
  benchmark.name = scenario.name;
  benchmark.rig = source->rig();
  benchmark.tags = sim::registered_tags(scenario.simulation.world);
  benchmark.slam = scenario.slam;
  benchmark.frames = harness::preload(*source, arguments.frames);
}

int bench_slam(const BenchSlamArguments& arguments) {
  harness::SlamBenchmark benchmark;
  benchmark.threads = arguments.threads;
  if (arguments.dataset.empty()) {
    record_simulation(arguments, benchmark);
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
