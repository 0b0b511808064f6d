// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/experiment/scenario.h"
#include "harness/search/search_space.h"
#include "harness/sets/run_set.h"

namespace vinebench::harness {

/// The part of a scenario's route that is driven.
struct RouteCut {
  std::size_t first = 0;              ///< waypoint where it begins
  std::optional<std::size_t> last{};  ///< waypoint where it ends; the route's last
  std::optional<double> duration{};   ///< s, at most
  auto operator<=>(const RouteCut&) const = default;
};

/// One scenario of a search.
struct Condition {
  Severities severities;
  RouteCut cut{};
  auto operator<=>(const Condition&) const = default;

  /// How many difficulties it has.
  int difficulties() const;
  /// The sum of its severities.
  double severity() const;
};

/// Which SLAM system is driven through a condition.
enum class Role {
  kSystem,     ///< the one that is to fail
  kReference,  ///< the one that is not to
};

/// "system", "reference".
const char* name_of(Role role);

struct Query {
  Condition condition;
  Role role = Role::kSystem;
  std::int64_t seed = 1;
  auto operator<=>(const Query&) const = default;
};

enum class RunVerdict {
  kPassed,
  kFailed,
  kImpossible,  ///< there is no such scenario: a value out of range, a box on a post
  kUnknown,     ///< the budget is spent, or the search interrupted
};

/// "passed", "failed", "impossible", "unknown".
const char* name_of(RunVerdict verdict);

struct Answer {
  RunVerdict verdict = RunVerdict::kUnknown;
  double excess = 0;               ///< as excess_of(), of a run that passed or failed
  std::string why{};               ///< which checks failed, or why there is no run
  std::filesystem::path folder{};  ///< of its results
};

/// What a search looks for, and in what.
struct SearchProblem {
  /// Reads the scenario with these overrides. Throws Error.
  std::function<ScenarioConfig(const std::vector<Override>&)> load;
  SearchSpace space;
  std::vector<Override> system{};                    ///< of the system that is to fail
  std::optional<std::vector<Override>> reference{};  ///< of the one that is not to, if there is one
  std::string bound{};                               ///< that is to be broken; any if empty
};

/// The scenario of a condition: what `blind`, `median`, `now` and guard ask, which hold for the
/// scenario as it is alone, is left out. Throws Error.
ScenarioConfig scenario_of(const SearchProblem& problem, const Condition& condition, Role role);

/// Throws Error, which names the difficulty, if one cannot be had at its mildest or its worst, or
/// the bound is none of the scenario's.
void check_problem(const SearchProblem& problem);

/// Difficulties that do not begin with the scenario's own values, by name: the least severity is a
/// jump there.
std::vector<std::string> jumps_of(const SearchProblem& problem);

/// Makes runs, as many as the budget allows: each once, and those are kept that an earlier search
/// has left in the folder.
using RunMaker = std::function<SetOutcome(const std::vector<PlannedRun>&)>;

/// Answers queries by runs. Asks that were answered before cost nothing.
class SearchRuns {
 public:
  /// The problem must outlive it. Runs go to `folder`/<role>/<condition>/seed-<n>.
  SearchRuns(const SearchProblem& problem, std::filesystem::path folder, RunMaker make,
             std::size_t budget);

  /// In the order of the queries; runs that are needed are made side by side. Beyond the budget
  /// all others are unknown.
  std::vector<Answer> ask(const std::vector<Query>& queries);
  Answer ask(const Query& query) { return ask(std::vector<Query>{query}).front(); }

  /// Runs that were asked for so far, also kept ones.
  std::size_t count() const { return counted_; }
  std::size_t left() const { return budget_ - counted_; }
  bool interrupted() const { return interrupted_; }
  /// What was asked, in that order, with its answer.
  const std::vector<std::pair<Query, Answer>>& log() const { return log_; }
  const SearchProblem& problem() const { return problem_; }

 private:
  /// What runs for a query, or why nothing can.
  struct Plan {
    std::optional<PlannedRun> run{};
    std::string impossible{};
  };
  const Plan& plan_of(const Query& query);
  Answer answer_of(const SetRun& run) const;

  const SearchProblem& problem_;
  std::filesystem::path folder_;
  RunMaker make_;
  std::size_t budget_;
  std::size_t counted_ = 0;
  bool interrupted_ = false;
  Expectations expectations_;
  Expectations goal_;
  std::map<Query, Plan> plans_;
  std::map<std::filesystem::path, Answer> answers_;  ///< by the run's folder
  std::vector<std::pair<Query, Answer>> log_;
};

}  // namespace vinebench::harness
