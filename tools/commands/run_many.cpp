// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/commands/run_many.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <optional>
#include <system_error>

#include "core/files/cache_folder.h"
#include "core/files/files.h"
#include "core/files/output_folder.h"
#include "core/util/error.h"
#include "harness/datasets/files/json_file.h"
#include "harness/jobs/run_scenario.h"
#include "harness/jobs/simulation_versions.h"
#include "harness/sets/junit.h"
#include "harness/sets/set_report.h"
#include "tools/arguments/command.h"
#include "tools/commands/interactive.h"
#include "tools/commands/report/open_page.h"

namespace vinebench::tools {
namespace {

namespace fs = std::filesystem;

/// Better before the runs than after them.
FolderLock prepare(const ManyRuns& many) {
  std::optional<FolderLock> lock;
  try {
    lock.emplace(many.out);
  } catch (const Error& error) {
    fail("output folder {}", error.what());
  }
  std::error_code ignored;
  for (const char* name : {"table.md", "summary.json"}) fs::remove(many.out / name, ignored);
  if (!many.junit.empty()) write_file_atomically(many.junit, "");
  return *std::move(lock);
}

/// Without a cache that cannot be used, of which each run would tell in its own messages alone.
harness::Machine checked_machine(harness::Machine machine) {
  const std::string problem = problem_of(machine.plant_cache);
  if (problem.empty()) return machine;
  if (machine.plant_cache.notice) {
    machine.plant_cache.notice("generated plants are not kept: " + problem);
  }
  machine.plant_cache = {};
  return machine;
}

int report(const ManyRuns& many, const std::vector<harness::SeedsSummary>& scenarios) {
  const std::string table = harness::format_table(scenarios);
  write_file_atomically(many.out / "table.md",
                        harness::format_table(scenarios, harness::TableColumns::kOfEstimate));
  write_file_atomically(many.out / "summary.json",
                        harness::json_text(harness::summary_json(scenarios), 2) + "\n");
  if (!many.junit.empty()) write_file_atomically(many.junit, harness::format_junit(scenarios));
  fmt::print("\n{}\n{}{}results: {}\n", table, harness::format_failures(scenarios),
             harness::format_repeats(scenarios), fs::absolute(many.out).string());
  const bool errors = std::ranges::any_of(scenarios, [](const harness::SeedsSummary& summary) {
    return std::ranges::any_of(summary.runs,
                               [](const harness::SetRun& run) { return !run.error.empty(); });
  });
  if (errors) return kBadInput;
  return std::ranges::all_of(scenarios, &harness::SeedsSummary::passed) ? 0 : kExpectationFailed;
}

}  // namespace

harness::SetOutcome make_planned_runs(const std::vector<harness::PlannedRun>& plan,
                                      const RunsAtOnce& how) {
  const harness::Machine machine = checked_machine(how.machine);
  catch_interrupts();
  harness::SetOptions options;
  options.jobs = how.jobs;
  options.threads = how.threads;
  options.force = how.force;
  options.run = [&machine, film = how.film](const harness::ScenarioConfig& scenario, int threads,
                                            harness::RunOptions run) {
    run.film = film;
    return harness::run_scenario(scenario, machine, threads, run);
  };
  options.libraries = [](const harness::ScenarioConfig& scenario) {
    return harness::drawing_libraries(scenario.simulation.renderer);
  };
  options.stopped = interrupted;
  options.progress = &std::cerr;
  return harness::run_set(plan, options);
}

MadeRuns make_runs(const ManyRuns& many) {
  std::vector<harness::PlannedRun> plan =
      harness::plan_set(many.scenarios, many.seeds, many.out, many.repeats);
  FolderLock lock = prepare(many);
  harness::SetOutcome outcome =
      make_planned_runs(plan, {many.machine, many.jobs, many.threads, many.force, many.report});
  if (outcome.interrupted) {
    const auto whole = std::ranges::count_if(
        outcome.runs, [](const harness::SetRun& run) { return run.result.has_value(); });
    fmt::print(stderr,
               "vinebench: stopped; {} of {} runs are whole in {}, and the same command goes on\n",
               whole, plan.size(), many.out.string());
  }
  return {std::move(lock), std::move(plan), std::move(outcome)};
}

int run_many(const ManyRuns& many) {
  const MadeRuns made = make_runs(many);
  if (made.outcome.interrupted) return interruption_code();
  const int code = report(many, harness::summarise(made.plan, made.outcome));
  const bool any = std::ranges::any_of(
      made.outcome.runs, [](const harness::SetRun& run) { return run.result.has_value(); });
  if (many.report && any) {
    write_report(many.out / kReportFile, {{many.out}, {}, many.report_bytes});
  }
  return code;
}

}  // namespace vinebench::tools
