// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/search/search_files.h"

#include <fmt/format.h>

#include <set>
#include <sstream>

#include "core/files/csv_field.h"
#include "harness/report/metric_table.h"
#include "harness/sweep/run_cost_estimate.h"

namespace vinebench::harness {
namespace {

/// As the reference drives it, or as the scenario says.
ScenarioConfig shared_scenario(const SearchProblem& problem, const Condition& condition) {
  SearchProblem plain = problem;
  plain.reference = std::vector<Override>();
  return scenario_of(plain, condition, Role::kReference);
}

std::string cut_text(const SearchRuns& runs, const Condition& condition) {
  const double whole =
      drive_duration(shared_scenario(runs.problem(), {condition.severities, RouteCut{}}));
  return fmt::format("{:.1f} of {:.1f} s of the route",
                     drive_duration(shared_scenario(runs.problem(), condition)), whole);
}

std::string settings_text(const std::vector<Override>& overrides) {
  std::string text;
  for (const auto& [key, value] : overrides) {
    text += fmt::format("{}`{}={}`", text.empty() ? "" : ", ", key, value);
  }
  return text.empty() ? "as the scenario has it" : text;
}

std::string excess_text(const Answer& answer) {
  return answer.verdict == RunVerdict::kPassed || answer.verdict == RunVerdict::kFailed
             ? fmt::format("{:+.2f}", answer.excess)
             : "–";
}

}  // namespace

std::string counter_example_yaml(const SearchRuns& runs, const CounterExample& example) {
  const SearchProblem& problem = runs.problem();
  ScenarioConfig scenario = shared_scenario(problem, example.condition);
  std::string text = "# A counter-example to " + scenario.name +
                     ", found by `vinebench search`: " + cut_text(runs, example.condition) +
                     ".\n# It differs by:\n";
  std::set<std::string> lines;
  for (const auto& [key, value] : overrides_at(problem.space, example.condition.severities)) {
    text += "#   " + key + ": " + value + "\n";
  }
  if (example.condition.difficulties() == 0) text += "#   nothing but the route\n";
  scenario.name += "-counter-example";
  scenario.description = "Counter-example: " + text_of(problem.space, example.condition.severities);
  return text + resolved_settings(std::move(scenario));
}

std::string search_report(const SearchRuns& runs, const CounterExample& example) {
  const SearchProblem& problem = runs.problem();
  std::string text = fmt::format(
      "# The mildest failure found\n\n"
      "- System: {}\n- Reference: {}\n- Broken is to be: {}\n"
      "- Found: {}, after {} runs\n- Shrunk to: {}; {}\n- Runs in all: {}\n",
      settings_text(problem.system), problem.reference ? settings_text(*problem.reference) : "none",
      problem.bound.empty() ? "any expectation or goal" : "`" + problem.bound + "`",
      text_of(problem.space, example.found.severities), example.runs_to_find,
      text_of(problem.space, example.condition.severities), cut_text(runs, example.condition),
      runs.count());
  if (example.wanted == 0) return text;
  const std::string other = problem.reference ? "reference" : "without the difficulties";
  text += fmt::format(
      "- Proof: {} of {} other seeds agree{}\n\n", example.agreeing(), example.wanted,
      example.proof.size() < example.wanted ? fmt::format(" ({} were run)", example.proof.size())
                                            : "");
  std::vector<std::vector<std::string>> rows{{"seed", "system", other, "excess", "what fails"}};
  for (const SeedProof& seed : example.proof) {
    rows.push_back({std::to_string(seed.seed), name_of(seed.system.verdict),
                    seed.other ? name_of(seed.other->verdict) : "–", excess_text(seed.system),
                    seed.holds() ? seed.system.why : "**does not agree** " + seed.system.why});
  }
  text += markdown_table(rows, 5) + "\nExcess: the binary logarithm of measured over allowed.\n";
  for (const auto& [condition, seed] : example.disagreed) {
    text += fmt::format("\nSeed {} did not agree on {} ({}): system {}, {} {}.\n", seed.seed,
                        text_of(problem.space, condition.severities), cut_text(runs, condition),
                        name_of(seed.system.verdict), other,
                        seed.other ? name_of(seed.other->verdict) : "not run");
  }
  return text;
}

std::string search_csv(const SearchRuns& runs) {
  const SearchSpace& space = runs.problem().space;
  std::string text = "system,seed,first_waypoint,last_waypoint,duration_s";
  for (const Difficulty& difficulty : space.difficulties) text += "," + csv_field(difficulty.name);
  text += ",verdict,excess,why,folder\n";
  std::set<Query> told;
  for (const auto& [query, answer] : runs.log()) {
    if (answer.verdict == RunVerdict::kUnknown || !told.insert(query).second) continue;
    const auto& [severities, cut] = query.condition;
    text += fmt::format("{},{},{},{},{}", name_of(query.role), query.seed, cut.first,
                        cut.last ? std::to_string(*cut.last) : "",
                        cut.duration ? fmt::format("{:g}", *cut.duration) : "");
    for (const double severity : severities) text += fmt::format(",{:g}", severity);
    text += fmt::format(",{},{:.3f},{},{}\n", name_of(answer.verdict), answer.excess,
                        csv_field(answer.why), csv_field(answer.folder.string()));
  }
  return text;
}

}  // namespace vinebench::harness
