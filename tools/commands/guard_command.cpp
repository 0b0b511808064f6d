// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "core/files/files.h"
#include "core/util/error.h"
#include "harness/experiment/bound_check.h"
#include "harness/sets/guard.h"
#include "harness/sets/seed_list.h"
#include "tools/arguments/options.h"
#include "tools/commands/commands.h"
#include "tools/commands/interactive.h"
#include "tools/commands/run_many.h"

namespace vinebench::tools {
namespace {

struct GuardArguments {
  std::string scenario;
  std::string seeds = "1..10";
  std::string out = "out/guard";
  int jobs = 1;
  int threads = default_threads();
  bool write = false;
  std::filesystem::path cache;
  harness::Machine machine;
};

std::vector<harness::StoredRun> results_of(const harness::SetOutcome& outcome) {
  std::vector<harness::StoredRun> runs;
  for (const harness::SetRun& run : outcome.runs) {
    if (!run.error.empty()) fail("{}, seed {}: {}", run.scenario, run.seed, run.error);
    if (run.result->json.contains("failure")) {
      fail("{}, seed {}: the SLAM system failed", run.scenario, run.seed);
    }
    if (run.failed()) {
      fmt::print(stderr, "vinebench: {}, seed {}: not all expectations and goals are met\n",
                 run.scenario, run.seed);
    }
    runs.push_back(*run.result);
  }
  return runs;
}

/// Without bounds that no run of the scenario can fail.
std::vector<harness::GuardBound> effective(std::vector<harness::GuardBound> bounds,
                                           const harness::ScenarioConfig& scenario) {
  const harness::RouteOutlook drive = harness::route_outlook(scenario);
  std::erase_if(bounds, [&](const harness::GuardBound& of) {
    return !harness::why_ineffective(*of.bound, of.value, drive).empty();
  });
  return bounds;
}

int guard(const GuardArguments& arguments) {
  harness::ScenarioConfig scenario = harness::load_scenario(arguments.scenario);
  sim::choose_backend(scenario.simulation.renderer, arguments.machine.gl_platform);
  scenario.guard.reset();  // no input of the runs, which are kept when it changes
  const std::vector<std::int64_t> seeds = harness::parse_seeds(arguments.seeds);
  if (seeds.size() < harness::kSeedsForGuard) {
    fail("--seeds: expected at least {} seeds, found {}", harness::kSeedsForGuard, seeds.size());
  }
  if (arguments.write) harness::check_guard_place(arguments.scenario);
  const MadeRuns made = make_runs({.scenarios = {scenario},
                                   .machine = with_cache(arguments.machine, arguments.cache),
                                   .seeds = seeds,
                                   .out = arguments.out,
                                   .junit = {},
                                   .jobs = arguments.jobs,
                                   .threads = arguments.threads});
  if (made.outcome.interrupted) return interruption_code();
  const std::string block =
      harness::format_guard(effective(harness::derive_guard(results_of(made.outcome)), scenario),
                            scenario.name, arguments.seeds);
  fmt::print("{}", block);
  if (!arguments.write) return 0;
  const std::filesystem::path file = arguments.scenario;
  write_file_atomically(file, harness::with_guard(read_file(file), block));
  harness::load_scenario(file);
  return 0;
}

}  // namespace

Command guard_command(const Surroundings& surroundings) {
  const auto arguments = std::make_shared<GuardArguments>();
  arguments->machine = surroundings.machine;
  return {.name = "guard",
          .description = "Derive a scenario's guard from runs of several seeds",
          .options = {{.name = "SCENARIO",
                       .target = &arguments->scenario,
                       .help = "Scenario file (YAML), or the name of a scenario",
                       .required = true,
                       .data = harness::DataKind::kScenario},
                      {.name = "--seeds",
                       .target = &arguments->seeds,
                       .help = "Seeds, e.g. 1..10",
                       .type = "LIST",
                       .show_default = true},
                      {.name = "--write",
                       .target = &arguments->write,
                       .help = "Write it into the scenario's file"},
                      {.name = "--out",
                       .target = &arguments->out,
                       .help = "Folder for the runs; whole ones are kept, and not run again",
                       .type = "FOLDER",
                       .show_default = true},
                      jobs_option(arguments->jobs),
                      threads_option(arguments->threads),
                      cache_option(arguments->cache)},
          .run = [arguments] { return guard(*arguments); }};
}

}  // namespace vinebench::tools
