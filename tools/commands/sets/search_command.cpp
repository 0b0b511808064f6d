// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

#include "core/files/files.h"
#include "core/files/output_folder.h"
#include "core/util/error.h"
#include "harness/experiment/trust.h"
#include "harness/search/operating_map.h"
#include "harness/search/search.h"
#include "harness/search/search_files.h"
#include "harness/sets/seed_list.h"
#include "harness/sweep/shards.h"
#include "tools/arguments/options.h"
#include "tools/commands/commands.h"
#include "tools/commands/interactive.h"
#include "tools/commands/run_many.h"

namespace vinebench::tools {
namespace {

namespace fs = std::filesystem;

struct SearchArguments {
  std::string scenario;
  std::string space;
  std::string find = "failure";
  std::vector<std::string> set;
  std::vector<std::string> against;
  std::string seeds = "1..3";
  std::vector<std::string> map;
  std::int64_t size = 7;
  std::int64_t budget = 200;
  std::int64_t proof = 20;
  std::int64_t random = 0;
  std::string shard;
  std::string out = "out/search";
  int jobs = 1;
  int threads = default_threads();
  bool untrusted = false;
  std::filesystem::path cache;
  Surroundings surroundings;
};

harness::SearchProblem problem_of(const SearchArguments& arguments) {
  harness::SearchProblem problem;
  const fs::path file = arguments.scenario;
  const std::string platform = arguments.surroundings.machine.gl_platform;
  std::optional<harness::Untrusted> untrusted;
  if (arguments.untrusted) untrusted = harness::Untrusted{arguments.surroundings.data_folders};
  problem.load = [file, platform, untrusted](const std::vector<Override>& overrides) {
    harness::ScenarioConfig scenario = harness::load_scenario(file, overrides);
    if (untrusted) harness::check_untrusted(scenario, file, *untrusted);
    if (scenario.earlier_visit) {
      fail("{}: a scenario with an earlier visit cannot be searched", file.string());
    }
    sim::choose_backend(scenario.simulation.renderer, platform);
    return scenario;
  };
  problem.space = harness::load_search_space(arguments.space);
  problem.system = parse_overrides(arguments.set);
  if (!arguments.against.empty()) problem.reference = parse_overrides(arguments.against);
  if (arguments.find != "failure") problem.bound = arguments.find;
  check_problem(problem);
  return problem;
}

std::vector<harness::Query> design(const SearchArguments& arguments,
                                   const harness::SearchProblem& problem,
                                   const std::vector<std::size_t>& axes, std::int64_t seed) {
  if (axes.empty()) return harness::first_queries(problem, seed);
  return harness::lattice_queries(problem, axes[0], axes[1],
                                  static_cast<std::size_t>(arguments.size), seed);
}

int make_shard(const SearchArguments& arguments, harness::SearchRuns& runs,
               const std::vector<harness::Query>& queries) {
  const harness::Shard shard = harness::parse_shard(arguments.shard);
  std::vector<harness::Query> mine;
  for (const std::size_t task : harness::tasks_of(shard, std::vector<double>(queries.size(), 1))) {
    mine.push_back(queries[task]);
  }
  runs.ask(mine);
  if (runs.interrupted()) return interruption_code();
  fmt::print("shard {}/{}: {} runs; the search itself begins without --shard, in the same folder\n",
             shard.index, shard.count, runs.count());
  return 0;
}

int make_map(const SearchArguments& arguments, harness::SearchRuns& runs,
             const std::vector<std::size_t>& axes, const std::vector<std::int64_t>& seeds,
             const harness::Tell& tell) {
  const harness::OperatingMap map = harness::map_envelope(
      runs, axes[0], axes[1], static_cast<std::size_t>(arguments.size), seeds, tell);
  const fs::path out = arguments.out;
  const harness::SearchSpace& space = runs.problem().space;
  const std::string name = runs.problem().load({}).name;
  write_file_atomically(out / "map.svg", harness::map_svg(map, space, name));
  write_file_atomically(out / "map.csv", harness::map_csv(map, space));
  if (runs.interrupted()) return interruption_code();
  fmt::print("{} runs; map.svg and map.csv are in {}\n", runs.count(), fs::absolute(out).string());
  return 0;
}

int find(const SearchArguments& arguments, harness::SearchRuns& runs,
         const std::vector<std::int64_t>& seeds, const harness::Tell& tell) {
  harness::SearchSettings settings;
  settings.seeds = seeds;
  settings.proof_seeds = static_cast<std::size_t>(arguments.proof);
  settings.first_proof_seed = *std::ranges::max_element(seeds) + 100;
  settings.at_once = static_cast<std::size_t>(arguments.jobs);
  if (arguments.random > 0) settings.random = static_cast<std::uint64_t>(arguments.random);
  const auto example = harness::search(runs, settings, tell);
  const fs::path out = arguments.out;
  write_file_atomically(out / "runs.csv", harness::search_csv(runs));
  if (runs.interrupted()) return interruption_code();
  if (!example) {
    fmt::print("nothing breaks it within {} runs; they are listed in {}\n", runs.count(),
               fs::absolute(out / "runs.csv").string());
    return kExpectationFailed;
  }
  write_file_atomically(out / "counter-example.yaml",
                        harness::counter_example_yaml(runs, *example));
  const std::string report = harness::search_report(runs, *example);
  write_file_atomically(out / "search.md", report);
  fmt::print("\n{}\ncounter-example.yaml, search.md and runs.csv are in {}\n", report,
             fs::absolute(out).string());
  return example->wanted == 0 || example->is_proven() ? 0 : kExpectationFailed;
}

int search(const SearchArguments& arguments) {
  const harness::SearchProblem problem = problem_of(arguments);
  const std::vector<std::int64_t> seeds = harness::parse_seeds(arguments.seeds);
  std::vector<std::size_t> axes;
  for (const std::string& name : arguments.map) {
    axes.push_back(harness::difficulty_named(problem.space, name));
  }
  if (!axes.empty() && axes.size() != 2) fail("--map: expected the names of two difficulties");
  const FolderLock lock(arguments.out);
  const RunsAtOnce how{with_cache(arguments.surroundings.machine, arguments.cache), arguments.jobs,
                       arguments.threads};
  harness::SearchRuns runs(
      problem, fs::path(arguments.out) / "runs",
      [&](const std::vector<harness::PlannedRun>& plan) { return make_planned_runs(plan, how); },
      static_cast<std::size_t>(arguments.budget));
  const harness::Tell tell = [&runs](const std::string& text) {
    fmt::print(stderr, "{:>4} runs: {}\n", runs.count(), text);
  };
  for (const std::string& name : jumps_of(problem)) {
    tell(fmt::format("note: '{}' does not begin with the scenario's own values", name));
  }
  if (!arguments.shard.empty()) {
    return make_shard(arguments, runs, design(arguments, problem, axes, seeds.front()));
  }
  return axes.empty() ? find(arguments, runs, seeds, tell)
                      : make_map(arguments, runs, axes, seeds, tell);
}

std::vector<Option> what_to_look_for(SearchArguments& arguments) {
  return {
      {.name = "SCENARIO",
       .target = &arguments.scenario,
       .help = "Scenario file (YAML), or the name of a scenario",
       .required = true,
       .data = harness::DataKind::kScenario},
      {.name = "--space",
       .target = &arguments.space,
       .help = "Difficulties, each from mild to severe (YAML)",
       .type = "FILE",
       .required = true,
       .existing = Existing::kFile},
      {.name = "--find",
       .target = &arguments.find,
       .help = "What is to break: failure, for any expectation or goal, or the key of one",
       .show_default = true},
      overrides_option(arguments.set, "Key of the system that is to fail"),
      {.name = "--against",
       .target = &arguments.against,
       .help = "Key of another system, which is to pass where this one fails; may be repeated",
       .type = "KEY=VALUE"},
      {.name = "--map",
       .target = &arguments.map,
       .help = "Instead: where in the plane of two difficulties it passes; twice, across and up",
       .type = "DIFFICULTY"}};
}

std::vector<Option> how_to_look(SearchArguments& arguments) {
  return {{.name = "--seeds",
           .target = &arguments.seeds,
           .help = "Seeds to search with; those of the proof are others",
           .show_default = true},
          {.name = "--proof",
           .target = &arguments.proof,
           .help = "Other seeds that are to agree on what was found",
           .show_default = true,
           .range = Range::between(0, 1000)},
          {.name = "--budget",
           .target = &arguments.budget,
           .help = "Runs at most, with those of the proof",
           .show_default = true,
           .range = Range::between(1, 100000)},
          {.name = "--map-size",
           .target = &arguments.size,
           .help = "Cells of a map along each side",
           .show_default = true,
           .range = Range::between(2, 65)},
          {.name = "--random",
           .target = &arguments.random,
           .help = "For comparison: draw conditions at random instead, with this number as seed",
           .range = Range::between(1, 1e9)},
          {.name = "--shard",
           .target = &arguments.shard,
           .help = "Make this part of the first runs alone, such as 3/16",
           .type = "I/N"},
          {.name = "--out",
           .target = &arguments.out,
           .help = "Folder for the runs and what they show",
           .type = "FOLDER",
           .show_default = true},
          jobs_option(arguments.jobs),
          threads_option(arguments.threads),
          cache_option(arguments.cache),
          untrusted_option(arguments.untrusted)};
}

}  // namespace

Command search_command(const Surroundings& surroundings) {
  const auto arguments = std::make_shared<SearchArguments>();
  arguments->surroundings = surroundings;
  std::vector<Option> options = what_to_look_for(*arguments);
  append(options, how_to_look(*arguments));
  return {.name = "search",
          .description = "Find the mildest conditions under which a scenario fails",
          .options = options,
          .footer =
              "Runs that are there are kept: the same command goes on. Exit code: 0 when a failure "
              "was found and all seeds of the proof agree, or the map is made; 1 when not, 2 for "
              "bad input, 130 when interrupted.",
          .run = [arguments] { return search(*arguments); }};
}

}  // namespace vinebench::tools
