// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <limits>
#include <memory>
#include <thread>

#include "scenarios/scenarios.h"
#include "tools/commands.h"
#include "tools/interactive.h"

namespace vinebench {
namespace {

struct RunArguments {
  std::string scenario;
  std::optional<std::int64_t> seed;
  std::string out;
  std::string record;
  std::vector<std::string> record_formats{"euroc"};
  std::vector<std::string> overrides;
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  bool verify_determinism = false;
  MapFiles maps;
};

ScenarioConfig scenario_of(const RunArguments& arguments) {
  ScenarioConfig scenario = load_scenario(arguments.scenario, parse_overrides(arguments.overrides));
  if (arguments.seed) scenario.seed = *arguments.seed;
  return scenario;
}

std::optional<RunRecording> recording_of(const RunArguments& arguments) {
  if (arguments.record.empty()) return std::nullopt;
  RunRecording recording{arguments.record, {}};
  recording.options.formats = parse_formats(arguments.record_formats);
  recording.options.threads = arguments.threads;
  return recording;
}

void print_verdict(const ScenarioConfig& scenario, const RunOutcome& outcome,
                   const std::filesystem::path& folder) {
  fmt::print("\n{}: {} ({} frames in {:.0f} s, hash {})\n{}results: {}\n", scenario.name,
             all_hold(outcome.checks) ? "PASSED" : "FAILED", outcome.frames,
             outcome.metrics["wall_seconds"].get<double>(), outcome.hash,
             format_checks(outcome.checks), std::filesystem::absolute(folder).string());
}

/// Runs once more, without files, and compares.
int verify_determinism(const ScenarioConfig& scenario, const RunArguments& arguments,
                       const std::string& first) {
  RunOptions options = interactive_options(scenario.name + " (again)");
  options.maps.load = arguments.maps.load;
  const RunOutcome again = run_scenario(scenario, arguments.threads, options);
  if (again.interrupted) {
    fmt::print(stderr, "vinebench: stopped in the second run; determinism is not verified\n");
    return interruption_code();
  }
  if (again.hash == first) {
    fmt::print("determinism: both runs have hash {}\n", first);
    return 0;
  }
  fmt::print("determinism: FAILED, the first run has hash {}, the second {}\n", first, again.hash);
  return kExpectationFailed;
}

int run(const RunArguments& arguments) {
  const ScenarioConfig scenario = scenario_of(arguments);
  const std::filesystem::path folder = arguments.out.empty()
                                           ? std::filesystem::path("out") / scenario.name
                                           : std::filesystem::path(arguments.out);
  prepare_run_folder(folder, scenario);
  catch_interrupts();
  RunOptions options = interactive_options(scenario.name);
  options.folder = folder;
  options.maps = arguments.maps;
  const RunOutcome outcome =
      run_scenario(scenario, arguments.threads, options, recording_of(arguments));
  if (outcome.interrupted) return report_interruption(outcome, folder);
  print_verdict(scenario, outcome, folder);
  std::fflush(stdout);
  const int repeated =
      arguments.verify_determinism ? verify_determinism(scenario, arguments, outcome.hash) : 0;
  return repeated != 0 ? repeated : all_hold(outcome.checks) ? 0 : kExpectationFailed;
}

}  // namespace

void add_run_command(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<RunArguments>();
  CLI::App* run = app.add_subcommand("run", "Run a scenario and judge it");
  run->add_option("SCENARIO", arguments->scenario, "Scenario file (YAML)")->required();
  run->add_option("--seed", arguments->seed, "Seed in place of the scenario's")
      ->check(CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()));
  run->add_option("--out", arguments->out,
                  "Folder for the results (default: out/<scenario's name>)");
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
  run->callback(
      [&chosen, arguments] { chosen = [arguments] { return vinebench::run(*arguments); }; });
}

}  // namespace vinebench
