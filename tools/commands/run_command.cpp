// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "core/util/error.h"
#include "harness/datasets/formats.h"
#include "harness/experiment/bound_check.h"
#include "harness/experiment/trust.h"
#include "harness/jobs/run_scenario.h"
#include "harness/run/hash_environment.h"
#include "harness/sets/seed_list.h"
#include "tools/arguments/options.h"
#include "tools/commands/commands.h"
#include "tools/commands/interactive.h"
#include "tools/commands/report/run_page.h"
#include "tools/commands/run_many.h"

namespace vinebench::tools {
namespace {

struct RunArguments {
  std::vector<std::string> scenarios;
  std::optional<std::int64_t> seed;
  std::string seeds;
  std::string out;
  std::string junit;
  int jobs = 1;
  int repeats = 1;
  bool force = false;
  std::string record;
  std::vector<std::string> record_formats{"euroc"};
  std::vector<std::string> record_cameras;
  std::vector<std::string> overrides;
  int threads = default_threads();
  bool verify_determinism = false;
  PageArguments page;
  harness::MapFiles maps;
  std::filesystem::path cache;
  harness::Machine machine;
  bool untrusted = false;
  std::vector<std::filesystem::path> data_folders;
};

/// For a scenario as its file says: overrides change the drive and leave the bounds.
void name_ineffective_bounds(const harness::ScenarioConfig& scenario, const std::string& file) {
  for (const auto& bound : harness::ineffective_bounds(scenario)) {
    fmt::print(stderr, "vinebench: {}: {}\n", file, bound.text());
  }
}

std::vector<harness::ScenarioConfig> scenarios_of(const RunArguments& arguments) {
  const std::vector<Override> overrides = parse_overrides(arguments.overrides);
  std::vector<harness::ScenarioConfig> scenarios;
  for (const std::string& file : arguments.scenarios) {
    scenarios.push_back(harness::load_scenario(file, overrides));
    if (arguments.untrusted) {
      harness::check_untrusted(scenarios.back(), file, {arguments.data_folders});
    }
    sim::choose_backend(scenarios.back().simulation.renderer, arguments.machine.gl_platform);
    if (overrides.empty()) name_ineffective_bounds(scenarios.back(), file);
    if (arguments.seed) scenarios.back().seed = *arguments.seed;
  }
  return scenarios;
}

std::optional<harness::RunRecording> recording_of(const RunArguments& arguments) {
  if (arguments.record.empty()) return std::nullopt;
  harness::RunRecording recording{arguments.record, {}};
  recording.options.formats = harness::parse_formats(arguments.record_formats);
  recording.options.cameras = arguments.record_cameras;
  recording.options.threads = arguments.threads;
  return recording;
}

void print_verdict(const harness::ScenarioConfig& scenario, const harness::RunOutcome& outcome,
                   const std::filesystem::path& folder) {
  fmt::print("\n{}: {} ({} frames in {:.0f} s, hash {})\n{}{}results: {}\n", scenario.name,
             harness::verdict_of(outcome.report.checks), outcome.report.frames,
             outcome.report.cost.wall_seconds, outcome.report.hash,
             harness::format_checks(outcome.report.checks), outcome.summary,
             std::filesystem::absolute(folder).string());
}

/// Runs once more, without files, and compares.
int verify_determinism(const harness::ScenarioConfig& scenario, const RunArguments& arguments,
                       const harness::RunReport& first) {
  harness::RunOptions options = interactive_options(scenario.name + " (again)");
  options.maps.load = arguments.maps.load;
  const harness::RunOutcome again =
      harness::run_scenario(scenario, arguments.machine, arguments.threads, options);
  if (again.interrupted) {
    fmt::print(stderr, "vinebench: stopped in the second run; determinism is not verified\n");
    return interruption_code();
  }
  if (const std::string names =
          harness::environment_differences(first.hash_environment, again.report.hash_environment);
      !names.empty()) {
    fmt::print("determinism: FAILED, the runs' hashes are not comparable, they differ in {}\n",
               names);
    return kExpectationFailed;
  }
  if (again.report.hash == first.hash) {
    fmt::print("determinism: both runs have hash {}\n", first.hash);
    return 0;
  }
  fmt::print("determinism: FAILED, the first run has hash {}, the second {}\n", first.hash,
             again.report.hash);
  return kExpectationFailed;
}

/// A recording, a map and a second run belong to one run alone.
int run_set(const RunArguments& arguments) {
  const harness::MapFiles& maps = arguments.maps;
  for (const auto& [option, given] :
       {std::pair("--record", !arguments.record.empty()),
        std::pair("--verify-determinism", arguments.verify_determinism),
        std::pair("--load-map", !maps.load.empty()), std::pair("--save-map", !maps.save.empty()),
        std::pair("--save-cloud", !maps.cloud.empty()),
        std::pair("--view", arguments.page.view.has_value())}) {
    if (given) fail("{}: is for one scenario without --seeds and --repeats", option);
  }
  return run_many({.scenarios = scenarios_of(arguments),
                   .machine = arguments.machine,
                   .seeds = arguments.seeds.empty() ? std::vector<std::int64_t>()
                                                    : harness::parse_seeds(arguments.seeds),
                   .out = arguments.out.empty() ? "out" : arguments.out,
                   .junit = arguments.junit,
                   .jobs = arguments.jobs,
                   .threads = arguments.threads,
                   .repeats = arguments.repeats,
                   .force = arguments.force,
                   .report = arguments.page.report,
                   .report_bytes = arguments.page.bytes()});
}

int run_one(const RunArguments& arguments) {
  const harness::ScenarioConfig scenario = scenarios_of(arguments).front();
  const std::filesystem::path folder = arguments.out.empty()
                                           ? std::filesystem::path("out") / scenario.name
                                           : std::filesystem::path(arguments.out);
  const FolderLock lock = harness::prepare_scenario_folder(folder, scenario);
  catch_interrupts();
  RunPage page(arguments.page, interrupted);
  harness::RunOptions options = interactive_options(scenario.name);
  options.folder = folder;
  options.maps = arguments.maps;
  page.join(options);
  const harness::RunOutcome outcome = harness::run_scenario(
      scenario, arguments.machine, arguments.threads, options, recording_of(arguments));
  if (outcome.interrupted) return report_interruption(outcome, folder);
  print_verdict(scenario, outcome, folder);
  page.finish(folder, harness::verdict_of(outcome.report.checks));
  std::fflush(stdout);
  const int repeated =
      arguments.verify_determinism ? verify_determinism(scenario, arguments, outcome.report) : 0;
  return repeated != 0                              ? repeated
         : harness::all_hold(outcome.report.checks) ? 0
                                                    : kExpectationFailed;
}

int run(RunArguments arguments) {
  arguments.machine = with_cache(arguments.machine, arguments.cache);
  const bool set =
      arguments.scenarios.size() > 1 || !arguments.seeds.empty() || arguments.repeats > 1;
  if (!set && (!arguments.junit.empty() || arguments.jobs > 1 || arguments.force)) {
    fail("--jobs, --junit, --force: expected several scenarios or --seeds, such as --seeds 1..5");
  }
  return set ? run_set(arguments) : run_one(arguments);
}

/// Of one run or many.
std::vector<Option> run_options(RunArguments& arguments) {
  return {{.name = "SCENARIO",
           .target = &arguments.scenarios,
           .help = "Scenario file (YAML), or the name of a scenario; one or several",
           .required = true,
           .data = harness::DataKind::kScenario},
          {.name = "--seed",
           .target = &arguments.seed,
           .help = "Seed in place of the scenario's",
           .range = Range::non_negative(),
           .excludes = "--seeds"},
          {.name = "--out",
           .target = &arguments.out,
           .help = "Folder for the results (default: out/<scenario's name>; with several runs out, "
                   "and there <scenario's name>/seed-<n>)",
           .type = "FOLDER"},
          overrides_option(arguments.overrides,
                           "Set a key of the scenario, e.g. world.sun.elevation_deg=20"),
          threads_option(arguments.threads),
          cache_option(arguments.cache),
          untrusted_option(arguments.untrusted)};
}

std::vector<Option> single_run_options(RunArguments& arguments) {
  return {{.name = "--record",
           .target = &arguments.record,
           .help = "Also write the sensors' data and the truth there, as a data set of record",
           .type = "FOLDER"},
          {.name = "--record-format",
           .target = &arguments.record_formats,
           .help = "Formats of it, as --format of record, commas between them (default: euroc)",
           .commas = true},
          {.name = "--record-cameras",
           .target = &arguments.record_cameras,
           .help = "Names of cameras of the rig in it (default: all)",
           .commas = true},
          {.name = "--verify-determinism",
           .target = &arguments.verify_determinism,
           .help = "Run twice and fail unless both runs are the same to the byte"}};
}

std::vector<Option> set_options(RunArguments& arguments) {
  return {{.name = "--seeds",
           .target = &arguments.seeds,
           .help = "Run each scenario with each of these seeds, e.g. 1..5 or 1,4,7",
           .type = "LIST"},
          jobs_option(arguments.jobs),
          {.name = "--repeats",
           .target = &arguments.repeats,
           .help = "Run each seed so many times, for systems that are not deterministic",
           .show_default = true,
           .range = Range::between(1, 1000)},
          {.name = "--force",
           .target = &arguments.force,
           .help = "Also run what is there already, of the same inputs"},
          {.name = "--junit",
           .target = &arguments.junit,
           .help = "Also write the verdicts as JUnit XML",
           .type = "FILE"}};
}

}  // namespace

Command run_command(const Surroundings& surroundings) {
  const auto arguments = std::make_shared<RunArguments>();
  arguments->machine = surroundings.machine;
  arguments->data_folders = surroundings.data_folders;
  Command command{.name = "run",
                  .description = "Run scenarios and judge them",
                  .options = run_options(*arguments),
                  .footer =
                      "Exit code: 0 when the scenario's expectations hold, 1 when they do "
                      "not (or the SLAM system fails, or two runs differ), 2 for bad input, 130 "
                      "when interrupted.",
                  .run = [arguments] { return tools::run(*arguments); }};
  append(command.options, report_options(arguments->page));
  append(command.options, view_options(arguments->page));
  append(command.options, set_options(*arguments));
  append(command.options, single_run_options(*arguments));
  append(command.options, map_options(arguments->maps));
  return command;
}

}  // namespace vinebench::tools
