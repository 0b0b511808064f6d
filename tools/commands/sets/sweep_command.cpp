// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <utility>

#include "core/files/files.h"
#include "core/files/output_folder.h"
#include "core/util/error.h"
#include "harness/catalogue/catalogue.h"
#include "harness/experiment/trust.h"
#include "harness/sets/set_report.h"
#include "harness/sweep/run_cost_estimate.h"
#include "harness/sweep/shards.h"
#include "harness/sweep/sweep_merge.h"
#include "harness/sweep/sweep_plan.h"
#include "tools/arguments/options.h"
#include "tools/commands/commands.h"
#include "tools/commands/interactive.h"
#include "tools/commands/run_many.h"

namespace vinebench::tools {
namespace {

namespace fs = std::filesystem;

/// A table of more runs is a file to look things up in.
constexpr std::size_t kShownRuns = 60;

constexpr const char* kSweepFolder = "out/sweep";

struct SweepArguments {
  std::string spec;
  std::string measured;
  std::string plan;
  std::string shard = "1/1";
  std::string out;
  std::vector<std::string> folders;
  int jobs = 1;
  int threads = default_threads();
  bool untrusted = false;
  std::filesystem::path cache;
  Surroundings surroundings;
};

harness::ScenarioLoader loader_of(const SweepArguments& arguments) {
  return [surroundings = arguments.surroundings, untrusted = arguments.untrusted](
             const std::string& name, const std::vector<Override>& overrides) {
    const fs::path file = surroundings.catalogue.find(harness::DataKind::kScenario, name);
    harness::ScenarioConfig scenario = harness::load_scenario(file, overrides);
    if (untrusted) harness::check_untrusted(scenario, file, {surroundings.data_folders});
    sim::choose_backend(scenario.simulation.renderer, surroundings.machine.gl_platform);
    return scenario;
  };
}

int plan(const SweepArguments& arguments) {
  harness::SweepSpec spec = harness::load_sweep_spec(arguments.spec);
  for (std::string& scenario : spec.scenarios) {
    scenario = harness::beside_or_name(arguments.spec, scenario);
  }
  std::map<std::string, double> measured;
  if (!arguments.measured.empty()) measured = harness::measured_costs(arguments.measured);
  const harness::SweepPlan plan =
      harness::make_plan(spec, loader_of(arguments), [&](const harness::ScenarioConfig& scenario) {
        const auto found = measured.find(scenario.name);
        return found != measured.end() ? found->second : harness::estimate_cost(scenario);
      });
  const std::string text = harness::format_plan(plan);
  if (arguments.out.empty()) {
    std::cout << text << std::flush;
    if (!std::cout) fail("the plan could not be written");
  } else {
    write_file_atomically(arguments.out, text);
  }
  double cost = 0;
  for (const harness::SweepTask& task : plan.tasks) cost += task.cost;
  fmt::print(stderr, "{} runs, about {:.1f} hours of one core\n", plan.tasks.size(), cost / 3600);
  return 0;
}

std::vector<double> costs_of(const harness::SweepPlan& plan) {
  std::vector<double> costs;
  for (const harness::SweepTask& task : plan.tasks) costs.push_back(task.cost);
  return costs;
}

/// Verdicts are for merge: a shard has done its work when all of its runs have results.
int run(const SweepArguments& arguments) {
  const harness::Shard shard = harness::parse_shard(arguments.shard);
  const harness::SweepPlan plan = harness::read_plan(arguments.plan);
  const std::vector<std::size_t> tasks = harness::tasks_of(shard, costs_of(plan));
  const fs::path out = arguments.out.empty() ? kSweepFolder : arguments.out;
  const std::vector<harness::PlannedRun> runs =
      harness::planned_runs(plan, tasks, loader_of(arguments), out);
  const harness::SetOutcome outcome =
      make_planned_runs(runs, {with_cache(arguments.surroundings.machine, arguments.cache),
                               arguments.jobs, arguments.threads});
  const auto whole = std::ranges::count_if(
      outcome.runs, [](const harness::SetRun& run) { return run.result.has_value(); });
  fmt::print("shard {}/{}: {} of {} runs are whole in {}\n", shard.index, shard.count, whole,
             runs.size(), out.string());
  if (outcome.interrupted) return interruption_code();
  return whole == static_cast<long>(runs.size()) ? 0 : kBadInput;
}

int merge(const SweepArguments& arguments) {
  const harness::SweepPlan plan = harness::read_plan(arguments.plan);
  std::vector<fs::path> folders(arguments.folders.begin(), arguments.folders.end());
  if (folders.empty()) folders.emplace_back(kSweepFolder);
  std::error_code ignored;
  for (const fs::path& folder : folders) {
    if (!fs::is_directory(folder, ignored))
      fail("{}: expected a folder of results", folder.string());
  }
  const fs::path out = arguments.out.empty() ? folders.front() : fs::path(arguments.out);
  const FolderLock lock(out);
  harness::MergedSweep merged = harness::merge_sweep(plan, folders, loader_of(arguments));
  const std::string csv = harness::format_csv(plan, merged);
  const auto passed = std::ranges::count_if(merged.outcome.runs, &harness::SetRun::passed);
  const auto scenarios = harness::summarise(merged.plan, std::move(merged.outcome));
  const std::string table = harness::format_table(scenarios, harness::TableColumns::kOfEstimate);
  const std::string failures = harness::format_failures(scenarios);
  write_file_atomically(out / "table.md", table);
  write_file_atomically(out / "results.csv", csv);
  write_file_atomically(out / "failures.txt", failures);
  if (plan.tasks.size() <= kShownRuns) fmt::print("{}\n{}", table, failures);
  fmt::print("{} runs: {} passed, {} failed, {} missing; table: {}\n", plan.tasks.size(), passed,
             plan.tasks.size() - static_cast<std::size_t>(passed) - merged.missing.size(),
             merged.missing.size(), fs::absolute(out / "table.md").string());
  if (!merged.missing.empty()) {
    std::fflush(stdout);
    fmt::print(stderr, "vinebench: {}", harness::format_missing(merged));
    return kBadInput;
  }
  return std::ranges::all_of(scenarios, &harness::SeedsSummary::passed) ? 0 : kExpectationFailed;
}

Option plan_option(SweepArguments& arguments) {
  return {.name = "PLAN",
          .target = &arguments.plan,
          .help = "A plan, as `sweep plan` prints it",
          .required = true,
          .existing = Existing::kFile};
}

Command sweep_plan_command(const std::shared_ptr<SweepArguments>& arguments) {
  return {
      .name = "plan",
      .description = "List all runs of a sweep, one a line, as JSON",
      .options = {{.name = "SPEC",
                   .target = &arguments->spec,
                   .help = "What is varied (YAML): scenarios, seeds, repeats, set, systems, grid",
                   .required = true,
                   .existing = Existing::kFile},
                  {.name = "--measured",
                   .target = &arguments->measured,
                   .help = "Folder with earlier runs, which tell what a scenario takes",
                   .type = "FOLDER",
                   .existing = Existing::kFolder},
                  {.name = "--out",
                   .target = &arguments->out,
                   .help = "File for the plan, in place of standard output",
                   .type = "FILE"}},
      .run = [arguments] { return plan(*arguments); }};
}

Command sweep_run_command(const std::shared_ptr<SweepArguments>& arguments) {
  return {
      .name = "run",
      .description = "Make those runs of a plan that are missing",
      .options = {plan_option(*arguments),
                  {.name = "--shard",
                   .target = &arguments->shard,
                   .help = "Which part of the plan, such as 3/16: parts take about as long",
                   .type = "I/N",
                   .show_default = true},
                  {.name = "--out",
                   .target = &arguments->out,
                   .help = "Folder for the results, which shards may share (default: out/sweep)",
                   .type = "FOLDER"},
                  jobs_option(arguments->jobs),
                  threads_option(arguments->threads),
                  cache_option(arguments->cache),
                  untrusted_option(arguments->untrusted)},
      .footer =
          "Exit code: 0 when all runs of the shard have results, whatever their verdict, 2 "
          "when one could not be made, 130 when interrupted. The same command goes on.",
      .run = [arguments] { return run(*arguments); }};
}

Command sweep_merge_command(const std::shared_ptr<SweepArguments>& arguments) {
  return {.name = "merge",
          .description = "Make one table of the results of all shards",
          .options = {plan_option(*arguments),
                      {.name = "FOLDER",
                       .target = &arguments->folders,
                       .help = "Folders of results, in any order (default: out/sweep)"},
                      {.name = "--out",
                       .target = &arguments->out,
                       .help = "Folder for table.md, results.csv and failures.txt (default: the "
                               "first FOLDER)",
                       .type = "FOLDER"}},
          .footer =
              "Exit code: 0 when all expectations hold, 1 when they do not, 2 for missing "
              "results and for results that do not belong together.",
          .run = [arguments] { return merge(*arguments); }};
}

}  // namespace

Command sweep_command(const Surroundings& surroundings) {
  const auto arguments = std::make_shared<SweepArguments>();
  arguments->surroundings = surroundings;
  return {.name = "sweep",
          .description = "Run many scenarios, seeds, systems and settings, in parts",
          .commands = {sweep_plan_command(arguments), sweep_run_command(arguments),
                       sweep_merge_command(arguments)}};
}

}  // namespace vinebench::tools
