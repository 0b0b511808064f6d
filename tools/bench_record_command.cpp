// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <thread>

#include "core/util/error.h"
#include "core/util/files.h"
#include "harness/benchmarks/record_benchmark.h"
#include "tools/commands.h"
#include "tools/gl_variable.h"
#include "tools/interactive.h"

namespace vinebench::tools {
namespace {

constexpr const char* kDefaultScenario = "scenarios/occluded-camera.yaml";

struct BenchRecordArguments {
  std::string scenario;
  std::string json;
  std::string folder;
  std::vector<std::string> overrides;
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::int64_t frames = 60;
};

int bench_record(const BenchRecordArguments& arguments) {
  const std::string file = arguments.scenario.empty() ? kDefaultScenario : arguments.scenario;
  if (!std::filesystem::exists(file)) {
    fail("bench record: no {} here; run it in the project's folder, or name a --scenario", file);
  }
  harness::RecordBenchmark benchmark;
  benchmark.scenario = harness::load_scenario(file, parse_overrides(arguments.overrides));
  sim::choose_backend(benchmark.scenario.simulation.renderer, gl_variable());
  benchmark.frames = arguments.frames;
  benchmark.threads = arguments.threads;
  const std::filesystem::path parent = arguments.folder.empty()
                                           ? std::filesystem::temp_directory_path()
                                           : std::filesystem::path(arguments.folder);
  benchmark.folder = parent / fmt::format("vinebench-bench-{}", getpid());
  const auto result = harness::measure_recording(benchmark);
  std::error_code ignored;
  std::filesystem::remove_all(benchmark.folder, ignored);
  fmt::print("{}", harness::record_table(result));
  if (!arguments.json.empty()) write_file_atomically(arguments.json, result.dump(2) + "\n");
  return 0;
}

}  // namespace

void add_bench_record(CLI::App& bench, Command& chosen) {
  const auto arguments = std::make_shared<BenchRecordArguments>();
  CLI::App* record = bench.add_subcommand(
      "record", "What recording costs beside the simulation: images, all labels, training sets");
  record->add_option("--scenario", arguments->scenario,
                     "Scenario to record (default: scenarios/occluded-camera.yaml)");
  record->add_option("--json", arguments->json, "Also write the results to this file");
  record
      ->add_option("--folder", arguments->folder,
                   "Where to record for the while (default: the folder for temporary files)")
      ->check(CLI::ExistingDirectory);
  record->add_option("--set", arguments->overrides, "Set a key of the scenario")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  record->add_option("--threads", arguments->threads, "Threads that draw, and that encode")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  record->add_option("--frames", arguments->frames, "Frames of the run")
      ->check(CLI::Range(2, 100000))
      ->capture_default_str();
  record->callback(
      [&chosen, arguments] { chosen = [arguments] { return bench_record(*arguments); }; });
}

}  // namespace vinebench::tools
