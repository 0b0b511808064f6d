// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/search/search_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <set>
#include <utility>

#include "core/util/error.h"
#include "harness/run/run_hash.h"
#include "harness/search/excess.h"
#include "harness/sweep/run_cost_estimate.h"

namespace vinebench::harness {
namespace {

void cut_route(sim::SimulationConfig& simulation, const RouteCut& cut) {
  auto& waypoints = simulation.route.waypoints;
  const std::size_t last = std::min(cut.last.value_or(waypoints.size() - 1), waypoints.size() - 1);
  waypoints.erase(waypoints.begin() + static_cast<std::ptrdiff_t>(last) + 1, waypoints.end());
  waypoints.erase(waypoints.begin(),
                  waypoints.begin() + static_cast<std::ptrdiff_t>(std::min(cut.first, last)));
  waypoints.front().lift = 0;
  if (cut.duration)
    simulation.duration = std::min(simulation.duration.value_or(1e9), *cut.duration);
}

std::string failed_checks(const StoredRun& run) {
  std::string text;
  for (const Check& check : failed_of(run.checks)) {
    text += fmt::format("{}{} {} (allowed {})", text.empty() ? "" : "; ", check.what,
                        check.measured, check.expected);
  }
  return text;
}

std::string cut_text(const ScenarioConfig& scenario, const RouteCut& cut) {
  return cut == RouteCut{} ? "" : fmt::format(", {:.1f} s", drive_duration(scenario));
}

/// Of all but the seed.
std::string digits_of(const ScenarioConfig& scenario) {
  ScenarioConfig any = scenario;
  any.seed = 0;
  RunHash hash;
  hash.add(resolved_settings(std::move(any)));
  return hash.digits().substr(0, 12);
}

}  // namespace

int Condition::difficulties() const {
  return static_cast<int>(std::ranges::count_if(severities, [](double s) { return s > 0; }));
}

double Condition::severity() const {
  return std::accumulate(severities.begin(), severities.end(), 0.0);
}

const char* name_of(Role role) {
  return role == Role::kSystem ? "system" : "reference";
}

const char* name_of(RunVerdict verdict) {
  switch (verdict) {
    case RunVerdict::kPassed:
      return "passed";
    case RunVerdict::kFailed:
      return "failed";
    case RunVerdict::kImpossible:
      return "impossible";
    case RunVerdict::kUnknown:
      break;
  }
  return "unknown";
}

ScenarioConfig scenario_of(const SearchProblem& problem, const Condition& condition, Role role) {
  std::vector<Override> overrides = overrides_at(problem.space, condition.severities);
  const auto& system = role == Role::kSystem ? problem.system : problem.reference.value();
  overrides.insert(overrides.end(), system.begin(), system.end());
  ScenarioConfig scenario = problem.load(overrides);
  for (Expectations* asked : {&scenario.expectations, &scenario.goal}) {
    asked->blind.reset();
    asked->median.reset();
  }
  scenario.now = {};
  scenario.guard.reset();
  cut_route(scenario.simulation, condition.cut);
  return scenario;
}

void check_problem(const SearchProblem& problem) {
  const std::size_t size = problem.space.difficulties.size();
  const ScenarioConfig plain = scenario_of(problem, {Severities(size)}, Role::kSystem);
  if (!problem.bound.empty()) check_bound(problem.bound, plain.expectations, plain.goal);
  for (std::size_t i = 0; i < size; ++i) {
    for (const double severity : {kSeverityStep, 1.0}) {
      Condition condition{Severities(size)};
      condition.severities[i] = severity;
      try {
        (void)scenario_of(problem, condition, Role::kSystem);
      } catch (const Error& error) {
        fail("difficulty '{}', severity {:.2g}: {}", problem.space.difficulties[i].name, severity,
             error.what());
      }
    }
  }
  if (problem.reference) (void)scenario_of(problem, {Severities(size)}, Role::kReference);
}

std::vector<std::string> jumps_of(const SearchProblem& problem) {
  const std::string plain = resolved_settings(problem.load({}));
  std::vector<std::string> names;
  for (const Difficulty& difficulty : problem.space.difficulties) {
    if (resolved_settings(problem.load(values_at(difficulty, 0))) != plain) {
      names.push_back(difficulty.name);
    }
  }
  return names;
}

SearchRuns::SearchRuns(const SearchProblem& problem, std::filesystem::path folder, RunMaker make,
                       std::size_t budget)
    : problem_(problem), folder_(std::move(folder)), make_(std::move(make)), budget_(budget) {
  const ScenarioConfig plain =
      scenario_of(problem, {Severities(problem.space.difficulties.size())}, Role::kSystem);
  expectations_ = plain.expectations;
  goal_ = plain.goal;
}

std::vector<Answer> SearchRuns::ask(const std::vector<Query>& queries) {
  std::vector<PlannedRun> runs;
  std::set<std::filesystem::path> folders;
  for (const Query& query : queries) {
    const Plan& plan = plan_of(query);
    if (!plan.run || answers_.contains(plan.run->folder) || interrupted_ || left() == 0) continue;
    if (!folders.insert(plan.run->folder).second) continue;
    ++counted_;
    runs.push_back(*plan.run);
  }
  if (!runs.empty()) {
    const SetOutcome outcome = make_(runs);
    interrupted_ = outcome.interrupted;
    for (const SetRun& run : outcome.runs) {
      if (run.result || !run.error.empty()) answers_[run.folder] = answer_of(run);
    }
  }
  std::vector<Answer> answers;
  for (const Query& query : queries) {
    const Plan& plan = plan_of(query);
    Answer answer;
    if (!plan.run) {
      answer = {RunVerdict::kImpossible, 0, plan.impossible};
    } else if (const auto found = answers_.find(plan.run->folder); found != answers_.end()) {
      answer = found->second;
    }
    log_.emplace_back(query, answer);
    answers.push_back(std::move(answer));
  }
  return answers;
}

const SearchRuns::Plan& SearchRuns::plan_of(const Query& query) {
  const auto known = plans_.find(query);
  if (known != plans_.end()) return known->second;
  Plan& plan = plans_[query];
  try {
    const auto scenario =
        std::make_shared<const ScenarioConfig>(scenario_of(problem_, query.condition, query.role));
    plan.run = {
        scenario, query.seed,
        folder_ / name_of(query.role) / digits_of(*scenario) / fmt::format("seed-{}", query.seed),
        fmt::format("{}, {}", name_of(query.role),
                    text_of(problem_.space, query.condition.severities) +
                        cut_text(*scenario, query.condition.cut))};
  } catch (const Error& error) {
    plan.impossible = error.what();
  }
  return plan;
}

Answer SearchRuns::answer_of(const SetRun& run) const {
  if (!run.error.empty()) return {RunVerdict::kImpossible, 0, run.error, run.folder};
  const double excess = excess_of(*run.result, expectations_, goal_, problem_.bound);
  const bool failed = problem_.bound.empty() ? run.failed() : excess > 0;
  return {failed ? RunVerdict::kFailed : RunVerdict::kPassed, excess, failed_checks(*run.result),
          run.folder};
}

}  // namespace vinebench::harness
