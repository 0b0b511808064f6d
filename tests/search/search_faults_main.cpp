// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0

// Plants faults in the estimator that show under certain conditions alone, and prints what
// `vinebench search` finds of each, and what a search at random takes to find as much.
// Usage: search_faults [--only NAME]... [--draws N] [--budget N] [--signs]. The table is Markdown,
// on standard output. Exit code 1 if a fault is not found and proven as the limits below ask.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>

#include "core/util/pin_arithmetic.h"
#include "harness/judge/results.h"
#include "harness/judge/verdict.h"
#include "harness/search/search.h"
#include "harness/sweep/run_cost_estimate.h"
#include "tests/search/honest_runs.h"

namespace vinebench::search_faults {
namespace {

using namespace harness;

constexpr double kLongest = 15;  // s, of a counter-example
constexpr int kMostDifficulties = 2;
constexpr double kAsMild = 1.1;  // times the sum of severities
constexpr double kCheaper = 3;   // than at random

struct Options {
  std::vector<std::string> only;
  std::size_t budget = 200;
  std::size_t draws = 3;     ///< searches at random
  std::size_t random = 300;  ///< runs of each, at most
};

SearchProblem problem_of() {
  const std::string folder = VINEBENCH_SOURCE_DIR "/tests/search/";
  SearchProblem problem;
  problem.load = [file = folder + "drive.yaml"](const std::vector<Override>& overrides) {
    return load_scenario(file, overrides);
  };
  problem.space = load_search_space(folder + "space.yaml");
  problem.reference = std::vector<Override>();
  check_problem(problem);
  return problem;
}

SearchRuns runs_of(const SearchProblem& problem, HonestRuns& honest, const PlantedFault& fault,
                   std::size_t budget) {
  return {problem, "runs",
          [&](const std::vector<PlannedRun>& plan) { return honest.make(plan, fault); }, budget};
}

/// Runs of each search at random until it has a condition as mild as that; the budget where it had
/// none.
std::vector<std::size_t> runs_at_random(const SearchProblem& problem, HonestRuns& honest,
                                        const PlantedFault& fault, const Condition& found,
                                        const Options& options) {
  std::vector<std::size_t> counts;
  for (std::size_t draw = 1; draw <= options.draws; ++draw) {
    SearchRuns runs = runs_of(problem, honest, fault, options.random);
    find_at_random(runs, 1, draw, found.difficulties(), kAsMild * found.severity());
    counts.push_back(runs.count());
  }
  std::ranges::sort(counts);
  return counts;
}

std::string counts_text(const std::vector<std::size_t>& counts, std::size_t most) {
  std::string text;
  for (const std::size_t count : counts) {
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ", count < most ? "" : "> ", count);
  }
  return text;
}

/// Prints the fault's row, and says whether it was found as it should.
bool search_one(const SearchProblem& problem, HonestRuns& honest, const PlantedFault& fault,
                const Options& options) {
  SearchRuns runs = runs_of(problem, honest, fault, options.budget);
  SearchSettings settings;
  settings.seeds = {1, 2, 3};
  const Tell tell = [&](const std::string& text) {
    fmt::print(stderr, "{}: {} runs: {}\n", fault.name, runs.count(), text);
  };
  const auto example = harness::search(runs, settings, tell);
  if (!example) {
    fmt::print("| `{}` | {} | **nothing** | | | | {} | |\n", fault.name, fault.text, runs.count());
    return false;
  }
  const Condition& condition = example->condition;
  const double seconds = drive_duration(scenario_of(problem, condition, Role::kSystem));
  const std::vector<std::size_t> random =
      runs_at_random(problem, honest, fault, example->found, options);
  fmt::print("| `{}` | {} | {} | {:.1f} | {}/{} | {} | {} | {} |\n", fault.name, fault.text,
             text_of(problem.space, condition.severities), seconds, example->agreeing(),
             example->wanted, example->runs_to_find, runs.count(),
             counts_text(random, options.random));
  std::fflush(stdout);
  return example->is_proven() && seconds <= kLongest &&
         condition.difficulties() <= kMostDifficulties &&
         (random.empty() || static_cast<double>(random[random.size() / 2]) >=
                                kCheaper * static_cast<double>(example->runs_to_find));
}

/// What the estimator could know at the worst of each difficulty, for whoever plants faults.
void print_signs(const SearchProblem& problem, HonestRuns& honest) {
  const std::size_t size = problem.space.difficulties.size();
  for (std::size_t i = 0; i <= size; ++i) {
    Condition condition{Severities(size)};
    if (i < size) condition.severities[i] = 1;
    const ScenarioConfig scenario = scenario_of(problem, condition, Role::kReference);
    const RunRecord& record = honest.record_of(scenario);
    Signs most;
    for (const Signs& signs : signs_of(record)) {
      most.dark = std::max(most.dark, signs.dark);
      most.speed = std::max(most.speed, signs.speed);
      most.turn_rate = std::max(most.turn_rate, signs.turn_rate);
      most.gap = std::max(most.gap, signs.gap);
      if (signs.tag_size > 0 && (most.tag_size == 0 || signs.tag_size < most.tag_size)) {
        most.tag_size = signs.tag_size;
      }
    }
    fmt::print("{:<60} dark {:.2f}, {:.2f} m/s, {:.2f} rad/s, gap {:.2f} s, tag {:.0f} px; {}\n",
               text_of(problem.space, condition.severities), most.dark, most.speed, most.turn_rate,
               most.gap, most.tag_size,
               verdict_of(check_trial(trial_of(scenario), measure(record, trial_of(scenario)))));
  }
}

int run(int argc, char** argv) {
  CLI::App app("Plants faults in the estimator and searches for them");
  Options options;
  bool signs = false;
  int threads = 1;
  app.add_option("--only", options.only, "names of faults");
  app.add_option("--budget", options.budget, "runs for each fault");
  app.add_option("--draws", options.draws, "searches at random for each fault");
  app.add_option("--random", options.random, "runs of each of those, at most");
  app.add_option("--threads", threads)->check(CLI::Range(1, 1024));
  app.add_flag("--signs", signs, "print what faults can go by instead");
  CLI11_PARSE(app, argc, argv);
  const SearchProblem problem = problem_of();
  HonestRuns honest(threads);
  if (signs) {
    print_signs(problem, honest);
    return 0;
  }
  fmt::print(
      "| fault | what is wrong | found and shrunk to | s | seeds that agree | runs to find | runs "
      "in "
      "all | at random, until as mild |\n|---|---|---|---|---|---|---|---|\n");
  bool all = true;
  for (const PlantedFault& fault : planted_faults()) {
    const auto& only = options.only;
    if (!only.empty() && std::ranges::find(only, fault.name) == only.end()) continue;
    all = search_one(problem, honest, fault, options) && all;
  }
  fmt::print(stderr, "{} runs of the core were made\n", honest.size());
  return all ? 0 : 1;
}

}  // namespace
}  // namespace vinebench::search_faults

int main(int argc, char** argv) {
  vinebench::pin_arithmetic();  // its shaders must not be mixed with other programs'
  try {
    return vinebench::search_faults::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "search_faults: {}\n", error.what());
    return 2;
  }
}
