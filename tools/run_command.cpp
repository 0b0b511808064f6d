// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <limits>
#include <memory>
#include <thread>

#include "core/util/error.h"
#include "harness/datasets/formats.h"
#include "harness/jobs/run_scenario.h"
#include "harness/sets/seed_list.h"
#include "tools/commands.h"
#include "tools/gl_variable.h"
#include "tools/interactive.h"
#include "tools/run_many.h"

namespace vinebench::tools {
namespace {

struct RunArguments {
  std::vector<std::string> scenarios;
  std::optional<std::int64_t> seed;
  std::string seeds;
  std::string out;
  std::string junit;
  int jobs = 1;
  bool force = false;
  std::string record;
  std::vector<std::string> record_formats{"euroc"};
  std::vector<std::string> overrides;
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  bool verify_determinism = false;
  harness::MapFiles maps;
};

std::vector<harness::ScenarioConfig> scenarios_of(const RunArguments& arguments) {
  const std::vector<Override> overrides = parse_overrides(arguments.overrides);
  std::vector<harness::ScenarioConfig> scenarios;
  for (const std::string& file : arguments.scenarios) {
    scenarios.push_back(harness::load_scenario(file, overrides));
    sim::choose_backend(scenarios.back().simulation.renderer, gl_variable());
    if (arguments.seed) scenarios.back().seed = *arguments.seed;
  }
  return scenarios;
}

std::optional<harness::RunRecording> recording_of(const RunArguments& arguments) {
  if (arguments.record.empty()) return std::nullopt;
  harness::RunRecording recording{arguments.record, {}};
  recording.options.formats = harness::parse_formats(arguments.record_formats);
  recording.options.threads = arguments.threads;
  return recording;
}

void print_verdict(const harness::ScenarioConfig& scenario, const harness::RunOutcome& outcome,
                   const std::filesystem::path& folder) {
  fmt::print("\n{}: {} ({} frames in {:.0f} s, hash {})\n{}{}results: {}\n", scenario.name,
             harness::all_hold(outcome.report.checks) ? "PASSED" : "FAILED", outcome.report.frames,
             outcome.report.cost.wall_seconds, outcome.report.hash,
             harness::format_checks(outcome.report.checks), outcome.summary,
             std::filesystem::absolute(folder).string());
}

/// Runs once more, without files, and compares.
int verify_determinism(const harness::ScenarioConfig& scenario, const RunArguments& arguments,
                       const std::string& first) {
  harness::RunOptions options = interactive_options(scenario.name + " (again)");
  options.maps.load = arguments.maps.load;
  const harness::RunOutcome again = harness::run_scenario(scenario, arguments.threads, options);
  if (again.interrupted) {
    fmt::print(stderr, "vinebench: stopped in the second run; determinism is not verified\n");
    return interruption_code();
  }
  if (again.report.hash == first) {
    fmt::print("determinism: both runs have hash {}\n", first);
    return 0;
  }
  fmt::print("determinism: FAILED, the first run has hash {}, the second {}\n", first,
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
        std::pair("--save-cloud", !maps.cloud.empty())}) {
    if (given) fail("{}: is for one scenario without --seeds", option);
  }
  return run_many({.scenarios = scenarios_of(arguments),
                   .seeds = arguments.seeds.empty() ? std::vector<std::int64_t>()
                                                    : harness::parse_seeds(arguments.seeds),
                   .out = arguments.out.empty() ? "out" : arguments.out,
                   .junit = arguments.junit,
                   .jobs = arguments.jobs,
                   .threads = arguments.threads,
                   .force = arguments.force});
}

int run_one(const RunArguments& arguments) {
  const harness::ScenarioConfig scenario = scenarios_of(arguments).front();
  const std::filesystem::path folder = arguments.out.empty()
                                           ? std::filesystem::path("out") / scenario.name
                                           : std::filesystem::path(arguments.out);
  harness::prepare_scenario_folder(folder, scenario);
  catch_interrupts();
  harness::RunOptions options = interactive_options(scenario.name);
  options.folder = folder;
  options.maps = arguments.maps;
  const harness::RunOutcome outcome =
      harness::run_scenario(scenario, arguments.threads, options, recording_of(arguments));
  if (outcome.interrupted) return report_interruption(outcome, folder);
  print_verdict(scenario, outcome, folder);
  std::fflush(stdout);
  const int repeated = arguments.verify_determinism
                           ? verify_determinism(scenario, arguments, outcome.report.hash)
                           : 0;
  return repeated != 0                              ? repeated
         : harness::all_hold(outcome.report.checks) ? 0
                                                    : kExpectationFailed;
}

int run(const RunArguments& arguments) {
  const bool set = arguments.scenarios.size() > 1 || !arguments.seeds.empty();
  if (!set && (!arguments.junit.empty() || arguments.jobs > 1 || arguments.force)) {
    fail("--jobs, --junit, --force: expected several scenarios or --seeds, such as --seeds 1..5");
  }
  return set ? run_set(arguments) : run_one(arguments);
}

void add_set_options(CLI::App& run, RunArguments& arguments) {
  run.add_option("--seeds", arguments.seeds,
                 "Run each scenario with each of these seeds, e.g. 1..5 or 1,4,7")
      ->type_name("LIST");
  run.add_option("--jobs", arguments.jobs, "Runs side by side, which share the threads")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  run.add_flag("--force", arguments.force, "Also run what is there already, of the same inputs");
  run.add_option("--junit", arguments.junit, "Also write the verdicts as JUnit XML")
      ->type_name("FILE");
}

}  // namespace

void add_run_command(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<RunArguments>();
  CLI::App* run = app.add_subcommand("run", "Run scenarios and judge them");
  run->add_option("SCENARIO", arguments->scenarios, "Scenario file (YAML), one or several")
      ->required();
  CLI::Option* seed =
      run->add_option("--seed", arguments->seed, "Seed in place of the scenario's")
          ->check(CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()));
  add_set_options(*run, *arguments);
  seed->excludes("--seeds");
  run->add_option("--out", arguments->out,
                  "Folder for the results (default: out/<scenario's name>; with several runs out, "
                  "and there <scenario's name>/seed-<n>)");
  run->add_option("--record", arguments->record,
                  "Also write the sensors' data and the truth there, as a data set of record");
  run->add_option("--record-format", arguments->record_formats,
                  "Formats of it, as --format of record, commas between them (default: euroc)")
      ->delimiter(',');
  run->add_option(
         "--set", arguments->overrides,
         "Set a key of the scenario, e.g. world.sun.elevation_deg=20; may stand many times")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  run->add_option("--threads", arguments->threads, "Threads to share the work; changes no result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  add_map_options(*run, arguments->maps);
  run->add_flag("--verify-determinism", arguments->verify_determinism,
                "Run twice and fail unless both runs are the same to the byte");
  run->footer(
      "Exit code: 0 when the scenario's expectations hold, 1 when they do not (or two runs "
      "differ), "
      "2 for bad input, 130 when interrupted.");
  run->callback([&chosen, arguments] { chosen = [arguments] { return tools::run(*arguments); }; });
}

}  // namespace vinebench::tools
