// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <thread>

#include "core/util/error.h"
#include "core/util/files.h"
#include "harness/benchmarks/measurement.h"
#include "harness/benchmarks/render_benchmark.h"
#include "harness/benchmarks/render_report.h"
#include "harness/experiment/scenario.h"
#include "sim/config_files.h"
#include "tools/commands.h"
#include "tools/gl_variable.h"

namespace vinebench::tools {
namespace {

using Json = nlohmann::ordered_json;

struct BenchArguments {
  std::vector<std::string> worlds;
  std::string rig = "models/csl-rover/rig.yaml";
  std::string json;
  std::string images;
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  int frames = 24;
  bool no_mujoco = false;
};

constexpr const char* kSmallWorld = "worlds/csl-vineyard.yaml";
constexpr const char* kLargeWorld = "worlds/typical-vineyard.yaml";
constexpr int kManyRows = 40;

harness::RenderBenchmark benchmark_of(const BenchArguments& arguments, const std::string& file) {
  harness::RenderBenchmark benchmark;
  benchmark.world = sim::load_world(file);
  benchmark.name = benchmark.world.name;
  benchmark.rig = load_rig(arguments.rig);
  benchmark.route = harness::aisle_route(benchmark.world, arguments.frames);
  benchmark.threads = arguments.threads;
  benchmark.mujoco = !arguments.no_mujoco && benchmark.name == "csl-vineyard";
  benchmark.images = arguments.images;
  sim::choose_backend(benchmark.renderer, gl_variable());
  return benchmark;
}

/// The large world with many rows more, of which as much is to be seen.
harness::RenderBenchmark with_many_rows(harness::RenderBenchmark benchmark) {
  const Override rows = parse_override(fmt::format("block.rows={}", kManyRows));
  benchmark.world = sim::load_world(kLargeWorld, {rows});
  benchmark.name += fmt::format(", {} rows", kManyRows);
  benchmark.route = harness::aisle_route(benchmark.world, static_cast<int>(benchmark.route.size()));
  return benchmark;
}

std::vector<harness::RenderBenchmark> benchmarks_of(const BenchArguments& arguments) {
  std::vector<harness::RenderBenchmark> benchmarks;
  for (const std::string& file : arguments.worlds) {
    benchmarks.push_back(benchmark_of(arguments, file));
  }
  if (!benchmarks.empty()) return benchmarks;
  for (const char* file : {kSmallWorld, kLargeWorld}) {
    if (std::filesystem::exists(file)) continue;
    fail("bench render: no {} here; run it in the project's folder or name a --world", file);
  }
  benchmarks.push_back(benchmark_of(arguments, kSmallWorld));
  benchmarks.push_back(benchmark_of(arguments, kLargeWorld));
  benchmarks.push_back(with_many_rows(benchmarks.back()));
  return benchmarks;
}

/// CPU time of a frame's images, each by itself, ms.
double frame_cpu(const Json& world) {
  double sum = 0;
  for (const Json& camera : world.at("cameras")) sum += camera.at("cpu_ms").get<double>();
  return sum;
}

/// How much more a frame costs where there are many more rows, percent.
double growth_percent(const Json& few, const Json& many) {
  return harness::rounded(100 * (frame_cpu(many) / frame_cpu(few) - 1));
}

int bench_render(const BenchArguments& arguments) {
  Json results{{"frames", arguments.frames}, {"threads", arguments.threads}};
  for (const harness::RenderBenchmark& benchmark : benchmarks_of(arguments)) {
    results["worlds"].push_back(harness::measure_rendering(benchmark));
    fmt::print("{}\n", harness::render_table(results["worlds"].back()));
    std::fflush(stdout);
  }
  if (arguments.worlds.empty()) {
    const Json& worlds = results["worlds"];
    const double growth = growth_percent(worlds[1], worlds[2]);
    results["growth_percent"] = growth;
    fmt::print("A frame costs {:+.1f} % of CPU time from {} to {} rows.\n", growth,
               worlds[1].at("rows").get<int>(), worlds[2].at("rows").get<int>());
  }
  if (!arguments.json.empty()) write_file_atomically(arguments.json, results.dump(2) + "\n");
  return 0;
}

}  // namespace

void add_bench_render(CLI::App& bench, Command& chosen) {
  const auto arguments = std::make_shared<BenchArguments>();
  CLI::App* render = bench.add_subcommand(
      "render", "Rendering, without SLAM, in the middle aisle: medians over the frames");
  render->add_option("--world", arguments->worlds,
                     "World files; csl-vineyard, typical-vineyard and the latter with 40 rows "
                     "where absent");
  render->add_option("--rig", arguments->rig, "Rig file")->capture_default_str();
  render->add_option("--json", arguments->json, "Also write the results to this file");
  render->add_option("--threads", arguments->threads, "Threads, to compare with one")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  render->add_option("--frames", arguments->frames, "Places on the route")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  render->add_flag("--no-mujoco", arguments->no_mujoco,
                   "Leave out MuJoCo's own renderer, which draws csl-vineyard for comparison");
  render
      ->add_option("--pictures", arguments->images,
                   "Folder for the images that the renderers made of the route's first place")
      ->check(CLI::ExistingDirectory);
  render->callback(
      [&chosen, arguments] { chosen = [arguments] { return bench_render(*arguments); }; });
}

}  // namespace vinebench::tools
