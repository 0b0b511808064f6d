// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/search/shrink.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "harness/sweep/run_cost_estimate.h"
#include "sim/rover/route.h"

namespace vinebench::harness {
namespace {

constexpr double kHarder = 1.0 / 16;  // severity
constexpr int kSteps = 4;             // of these, at most

/// The least number in (low, high] for which it holds, as if it held from there on; `high` does.
std::size_t least(std::size_t low, std::size_t high,
                  const std::function<bool(std::size_t)>& holds) {
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    (holds(middle) ? high : low) = middle;
  }
  return high;
}

class Shrinking {
 public:
  Shrinking(SearchRuns& runs, const std::vector<std::int64_t>& seeds, const Tell& tell)
      : runs_(runs), seeds_(seeds), tell_(tell) {}

  std::vector<Condition> shrink(const Condition& found) {
    std::vector<Condition> steps{drop_difficulties(with_all_seeds(found))};
    for (const auto& step :
         {&Shrinking::end_earlier, &Shrinking::start_later, &Shrinking::drive_shorter}) {
      const Condition shorter = (this->*step)(steps.back());
      if (shorter == steps.back() || !holds_for_all(shorter)) continue;
      steps.push_back(shorter);
      tell_(fmt::format("route shortened to {:.1f} s", duration_of(shorter)));
    }
    return steps;
  }

 private:
  bool holds(const Condition& condition, std::int64_t seed) {
    if (!breaks(runs_, condition, seed)) return false;
    if (runs_.problem().reference || condition.cut == RouteCut{}) return true;
    return runs_.ask({plain_of(condition), Role::kSystem, seed}).verdict == RunVerdict::kPassed;
  }

  bool holds(const Condition& condition) { return holds(condition, seeds_.front()); }

  bool holds_for_all(const Condition& condition) {
    return std::ranges::all_of(seeds_, [&](std::int64_t seed) { return holds(condition, seed); });
  }

  /// As it is where no severity makes them agree.
  Condition with_all_seeds(const Condition& condition) {
    Condition harsher = condition;
    for (int steps = 0; steps <= kSteps; ++steps) {
      if (holds_for_all(harsher)) return harsher;
      harsher = harder(harsher);
    }
    return condition;
  }

  Condition drop_difficulties(Condition condition) {
    for (std::size_t i = 0; i < condition.severities.size(); ++i) {
      if (condition.severities[i] <= 0 || condition.difficulties() < 2) continue;
      Condition fewer = condition;
      fewer.severities[i] = 0;
      if (holds_for_all(fewer)) condition = fewer;
    }
    return condition;
  }

  std::vector<sim::RouteConfig::Waypoint> waypoints() const {
    const SearchProblem& problem = runs_.problem();
    const Condition plain{Severities(problem.space.difficulties.size())};
    return scenario_of(problem, plain, Role::kSystem).simulation.route.waypoints;
  }

  Condition end_earlier(const Condition& condition) {
    const std::size_t end = condition.cut.last.value_or(waypoints().size() - 1);
    if (end < condition.cut.first + 2) return condition;
    const auto ended = [&condition](std::size_t last) {
      Condition shorter = condition;
      shorter.cut.last = last;
      return shorter;
    };
    const std::size_t last =
        least(condition.cut.first, end, [&](std::size_t middle) { return holds(ended(middle)); });
    return last == end ? condition : ended(last);
  }

  Condition start_later(const Condition& condition) {
    const std::size_t end = condition.cut.last.value_or(waypoints().size() - 1);
    const auto started = [&condition](std::size_t first) {
      Condition shorter = condition;
      shorter.cut.first = first;
      return shorter;
    };
    // By the number of waypoints that are left.
    const std::size_t left = least(0, end - condition.cut.first,
                                   [&](std::size_t count) { return holds(started(end - count)); });
    return left == end - condition.cut.first ? condition : started(end - left);
  }

  Condition drive_shorter(const Condition& condition) {
    const auto lasting = [&condition](std::size_t seconds) {
      Condition shorter = condition;
      shorter.cut.duration = static_cast<double>(seconds);
      return shorter;
    };
    const auto all = static_cast<std::size_t>(std::ceil(duration_of(condition)));
    if (all < 2) return condition;
    const std::size_t seconds =
        least(0, all, [&](std::size_t middle) { return holds(lasting(middle)); });
    return seconds == all ? condition : lasting(seconds);
  }

  double duration_of(const Condition& condition) const {
    return drive_duration(scenario_of(runs_.problem(), condition, Role::kSystem));
  }

  SearchRuns& runs_;
  const std::vector<std::int64_t>& seeds_;
  const Tell& tell_;
};

}  // namespace

std::vector<Condition> shrink(SearchRuns& runs, const Condition& condition,
                              const std::vector<std::int64_t>& seeds, const Tell& tell) {
  return Shrinking(runs, seeds, tell).shrink(condition);
}

Condition harder(const Condition& condition) {
  Condition harsher = condition;
  for (double& severity : harsher.severities) {
    if (severity > 0) severity = std::min(1.0, severity + kHarder);
  }
  return harsher;
}

Condition plain_of(const Condition& condition) {
  return {Severities(condition.severities.size()), condition.cut};
}

}  // namespace vinebench::harness
