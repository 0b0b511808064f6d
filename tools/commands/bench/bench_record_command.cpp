// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "core/files/files.h"
#include "core/files/output_folder.h"
#include "harness/benchmarks/record_benchmark.h"
#include "harness/datasets/files/json_file.h"
#include "harness/experiment/trust.h"
#include "tools/arguments/options.h"
#include "tools/commands/commands.h"

namespace vinebench::tools {
namespace {

constexpr const char* kRecordedByDefault = "occluded-camera";

struct BenchRecordArguments {
  std::string scenario;
  std::string json;
  std::string folder;
  std::filesystem::path cache;
  std::vector<std::string> overrides;
  int threads = default_threads();
  std::int64_t frames = 60;
  int rounds = 1;
  bool untrusted = false;
};

int bench_record(const BenchRecordArguments& arguments, const Surroundings& surroundings) {
  const std::string scenario = arguments.scenario.empty() ? kRecordedByDefault : arguments.scenario;
  harness::RecordBenchmark benchmark;
  const std::filesystem::path file =
      surroundings.catalogue.find(harness::DataKind::kScenario, scenario);
  benchmark.scenario = harness::load_scenario(file, parse_overrides(arguments.overrides));
  if (arguments.untrusted) {
    harness::check_untrusted(benchmark.scenario, file, {surroundings.data_folders});
  }
  sim::choose_backend(benchmark.scenario.simulation.renderer, surroundings.machine.gl_platform);
  benchmark.plant_cache = with_cache(surroundings.machine, arguments.cache).plant_cache;
  benchmark.frames = arguments.frames;
  benchmark.rounds = arguments.rounds;
  benchmark.threads = arguments.threads;
  const TemporaryFolder folder(arguments.folder);
  benchmark.folder = folder.path();
  const auto result = harness::measure_recording(benchmark);
  fmt::print("{}", harness::record_table(result));
  if (!arguments.json.empty())
    write_file_atomically(arguments.json, harness::json_text(result, 2) + "\n");
  return 0;
}

}  // namespace

Command bench_record_command(const Surroundings& surroundings) {
  const auto arguments = std::make_shared<BenchRecordArguments>();
  return {.name = "record",
          .description =
              "What recording costs beside the simulation: images, all labels, training sets",
          .options = {{.name = "--scenario",
                       .target = &arguments->scenario,
                       .help = "Scenario to record (default: occluded-camera)",
                       .data = harness::DataKind::kScenario},
                      json_option(arguments->json),
                      {.name = "--folder",
                       .target = &arguments->folder,
                       .help = "Where to record meanwhile (default: the temporary folder)",
                       .existing = Existing::kFolder},
                      overrides_option(arguments->overrides, "Set a key of the scenario"),
                      threads_option(arguments->threads),
                      cache_option(arguments->cache),
                      untrusted_option(arguments->untrusted),
                      {.name = "--frames",
                       .target = &arguments->frames,
                       .help = "Frames of the run",
                       .show_default = true,
                       .range = Range::between(2, 100000)},
                      {.name = "--rounds",
                       .target = &arguments->rounds,
                       .help = "How often each kind is measured, in turn; the median counts",
                       .show_default = true,
                       .range = Range::between(1, 100)}},
          .run = [arguments, surroundings] { return bench_record(*arguments, surroundings); }};
}

}  // namespace vinebench::tools
