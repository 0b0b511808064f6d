// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <thread>

#include "core/util/files.h"
#include "harness/benchmarks/measurement.h"
#include "harness/benchmarks/render_benchmark.h"
#include "harness/benchmarks/render_case.h"
#include "harness/benchmarks/render_report.h"
#include "tools/commands.h"
#include "tools/gl_variable.h"

namespace vinebench::tools {
namespace {

using Json = nlohmann::ordered_json;

struct BenchArguments {
  harness::RenderSuite suite;
  std::string json;
  bool no_mujoco = false;
};

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
  harness::RenderSuite suite = arguments.suite;
  suite.mujoco = !arguments.no_mujoco;
  suite.gl_platform = gl_variable();
  Json results{{"frames", suite.frames}, {"threads", suite.threads}};
  for (const harness::RenderBenchmark& benchmark : harness::render_cases(suite)) {
    results["worlds"].push_back(harness::measure_rendering(benchmark));
    fmt::print("{}\n", harness::render_table(results["worlds"].back()));
    std::fflush(stdout);
  }
  if (suite.worlds.empty()) {
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
  arguments->suite.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  CLI::App* render = bench.add_subcommand(
      "render", "Rendering, without SLAM, in the middle aisle: medians over the frames");
  render->add_option("--world", arguments->suite.worlds,
                     "World files; csl-vineyard, typical-vineyard and the latter with 40 rows "
                     "where absent");
  render->add_option("--rig", arguments->suite.rig, "Rig file")->capture_default_str();
  render->add_option("--json", arguments->json, "Also write the results to this file");
  render->add_option("--threads", arguments->suite.threads, "Threads, to compare with one")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  render->add_option("--frames", arguments->suite.frames, "Places on the route")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  render->add_flag("--no-mujoco", arguments->no_mujoco,
                   "Leave out MuJoCo's own renderer, which draws csl-vineyard for comparison");
  render
      ->add_option("--pictures", arguments->suite.images,
                   "Folder for the images that the renderers made of the route's first place")
      ->check(CLI::ExistingDirectory);
  render->callback(
      [&chosen, arguments] { chosen = [arguments] { return bench_render(*arguments); }; });
}

}  // namespace vinebench::tools
