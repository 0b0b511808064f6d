// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <thread>

#include "scenarios/render_benchmark.h"
#include "scenarios/snapshot.h"
#include "slam/base/files.h"
#include "tools/commands.h"

namespace vinebench {
namespace {

struct BenchArguments {
  std::vector<std::string> worlds{"worlds/csl-vineyard.yaml"};
  std::string rig = "models/csl-rover/rig.yaml";
  std::string json;
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  int frames = 24;
};

int bench_render(const BenchArguments& arguments) {
  nlohmann::ordered_json results;
  for (const std::string& file : arguments.worlds) {
    RenderBenchmark benchmark;
    benchmark.world = load_world(file);
    benchmark.name = benchmark.world.name;
    benchmark.rig = load_rig(arguments.rig);
    benchmark.route = aisle_route(benchmark.world, arguments.frames);
    results.push_back(measure_rendering(benchmark, arguments.threads));
    fmt::print("{}\n", results.back().dump(2));
  }
  if (!arguments.json.empty()) write_file_atomically(arguments.json, results.dump(2) + "\n");
  return 0;
}

}  // namespace

void add_bench_command(CLI::App& app, Command& chosen) {
  CLI::App* bench = app.add_subcommand("bench", "Measure the speed of a part");
  bench->require_subcommand(1);
  const auto arguments = std::make_shared<BenchArguments>();
  CLI::App* render = bench->add_subcommand("render", "Rendering, without SLAM");
  render->add_option("--world", arguments->worlds, "World files");
  render->add_option("--rig", arguments->rig, "Rig file")->capture_default_str();
  render->add_option("--json", arguments->json, "Also write the results to this file");
  render->add_option("--threads", arguments->threads, "Threads")->check(CLI::Range(1, 64));
  render->add_option("--frames", arguments->frames, "Places on the route")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  render->callback(
      [&chosen, arguments] { chosen = [arguments] { return bench_render(*arguments); }; });
}

}  // namespace vinebench
