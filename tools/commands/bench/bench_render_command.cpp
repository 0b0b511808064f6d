// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>

#include "core/files/files.h"
#include "core/files/output_folder.h"
#include "harness/benchmarks/measurement.h"
#include "harness/benchmarks/render_benchmark.h"
#include "harness/benchmarks/render_case.h"
#include "harness/benchmarks/render_report.h"
#include "harness/datasets/files/json_file.h"
#include "tools/arguments/options.h"
#include "tools/commands/commands.h"

namespace vinebench::tools {
namespace {

using Json = nlohmann::ordered_json;

struct BenchArguments {
  harness::RenderSuite suite;
  std::string json;
  bool no_mujoco = false;
  std::filesystem::path cache;
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

int bench_render(const BenchArguments& arguments, const Surroundings& surroundings) {
  harness::RenderSuite suite = arguments.suite;
  suite.mujoco = !arguments.no_mujoco;
  suite.machine = with_cache(surroundings.machine, arguments.cache);
  std::optional<FolderLock> lock;
  if (!suite.images.empty()) lock.emplace(suite.images);
  const harness::Catalogue& catalogue = surroundings.catalogue;
  if (suite.rig.empty()) suite.rig = catalogue.find(harness::DataKind::kRig, "csl-rover").string();
  suite.small_world = catalogue.find(harness::DataKind::kWorld, "csl-vineyard").string();
  suite.large_world = catalogue.find(harness::DataKind::kWorld, "typical-vineyard").string();
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
  if (!arguments.json.empty())
    write_file_atomically(arguments.json, harness::json_text(results, 2) + "\n");
  return 0;
}

}  // namespace

Command bench_render_command(const Surroundings& surroundings) {
  const auto arguments = std::make_shared<BenchArguments>();
  harness::RenderSuite& suite = arguments->suite;
  suite.threads = default_threads();
  return {.name = "render",
          .description = "Rendering, without SLAM, in the middle aisle: medians over the frames",
          .options = {{.name = "--world",
                       .target = &suite.worlds,
                       .help = "Worlds; csl-vineyard, typical-vineyard and the latter with 40 rows "
                               "where absent",
                       .data = harness::DataKind::kWorld},
                      {.name = "--rig",
                       .target = &suite.rig,
                       .help = "Rig (default: csl-rover)",
                       .data = harness::DataKind::kRig},
                      json_option(arguments->json),
                      threads_option(suite.threads),
                      cache_option(arguments->cache),
                      {.name = "--frames",
                       .target = &suite.frames,
                       .help = "Places on the route",
                       .show_default = true,
                       .range = Range::between(1, 10000)},
                      {.name = "--no-mujoco",
                       .target = &arguments->no_mujoco,
                       .help = "Leave out MuJoCo's own renderer, which draws csl-vineyard for "
                               "comparison"},
                      {.name = "--pictures",
                       .target = &suite.images,
                       .help = "Folder for the images of the route's first place",
                       .existing = Existing::kFolder}},
          .run = [arguments, surroundings] { return bench_render(*arguments, surroundings); }};
}

}  // namespace vinebench::tools
