// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/verdict.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "harness/judge/bounds.h"

namespace vinebench::harness {
namespace {

/// An expectation whose metric was not measured fails.
void add_check(const Bound& bound, const Expectations& asked, const RunResults& results,
               std::vector<Check>& checks) {
  const std::optional<double> allowed = bound.asked(asked);
  if (!allowed) return;
  const std::optional<double> measured = bound.measured(results);
  const bool ok = measured && (bound.at_least ? *measured >= *allowed : *measured <= *allowed);
  checks.push_back({bound.what, measured ? text_of(bound, *measured) : "none",
                    (bound.at_least ? ">= " : "<= ") + text_of(bound, *allowed), ok});
}

void check_blind(const Expectations& asked, const RunResults& results, std::vector<Check>& checks) {
  if (!asked.blind) return;
  const std::optional<OcclusionSegment>& blind = results.blind;
  const double seconds = blind ? blind->seconds : 0;
  checks.push_back({"blind in motion", fmt::format("{:.4f} s", seconds),
                    fmt::format(">= {:.4f} s", asked.blind->seconds),
                    seconds >= asked.blind->seconds});
  const std::optional<double> least = asked.blind->inliers_drop;
  if (!least) return;
  const std::optional<double> drop = blind ? blind->inliers_drop() : std::nullopt;
  checks.push_back({"inliers' drop while blind", drop ? fmt::format("{:.4f}", *drop) : "none",
                    fmt::format(">= {:.4f}", *least), drop && *drop >= *least});
}

constexpr std::size_t kWidestColumn = 40;  // longer texts stand out

const char* outcome_of(const Check& check) {
  return check.ok ? "ok" : check.open ? "open" : "FAILED";
}

std::size_t widest(const std::vector<Check>& checks, std::string Check::*column) {
  std::size_t width = 0;
  for (const Check& check : checks) {
    const std::size_t size = (check.*column).size();
    if (size <= kWidestColumn) width = std::max(width, size);
  }
  return width;
}

}  // namespace

const char* name_of(CheckKind kind) {
  switch (kind) {
    case CheckKind::kGoal:
      return "goal";
    case CheckKind::kGuard:
      return "guard";
    case CheckKind::kNow:
      return "now";
    case CheckKind::kExpectation:
      break;
  }
  return "expectation";
}

CheckKind kind_of(const std::string& name) {
  for (const CheckKind kind : {CheckKind::kGoal, CheckKind::kGuard, CheckKind::kNow}) {
    if (name == name_of(kind)) return kind;
  }
  return CheckKind::kExpectation;
}

std::vector<Check> check_expectations(const Expectations& asked, const RunResults& results,
                                      CheckKind kind) {
  std::vector<Check> checks;
  for (const Bound& bound : bounds()) add_check(bound, asked, results, checks);
  check_blind(asked, results, checks);
  for (Check& check : checks) check.kind = kind;
  return checks;
}

std::vector<Check> check_trial(const Trial& trial, const RunResults& results) {
  std::vector<Check> checks = check_expectations(trial.expectations, results);
  std::ranges::move(check_expectations(trial.goal, results, CheckKind::kGoal),
                    std::back_inserter(checks));
  std::ranges::move(check_expectations(trial.now, results, CheckKind::kNow),
                    std::back_inserter(checks));
  std::ranges::move(check_expectations(trial.guard, results, CheckKind::kGuard),
                    std::back_inserter(checks));
  mark_open_goals(checks);
  return checks;
}

void mark_open_goals(std::vector<Check>& checks) {
  for (Check& goal : checks) {
    if (goal.ok || goal.kind != CheckKind::kGoal) continue;
    goal.open = std::ranges::any_of(checks, [&](const Check& check) {
      return check.kind == CheckKind::kNow && check.what == goal.what && check.ok;
    });
  }
}

std::string verdict_of(const std::vector<Check>& checks) {
  if (all_hold(checks)) return goal_open(checks) ? "PASSED (goal open)" : "PASSED";
  std::vector<std::string> kinds;
  for (const Check& check : checks) {
    const std::string kind = name_of(check.kind);
    if (!check.holds() && std::ranges::count(kinds, kind) == 0) kinds.push_back(kind);
  }
  if (kinds == std::vector<std::string>{name_of(CheckKind::kExpectation)}) return "FAILED";
  return fmt::format("FAILED ({})", fmt::join(kinds, ", "));
}

bool all_hold(const std::vector<Check>& checks) {
  return std::ranges::all_of(checks, &Check::holds);
}

bool goal_open(const std::vector<Check>& checks) {
  return std::ranges::any_of(checks, &Check::open);
}

std::vector<Check> failed_of(const std::vector<Check>& checks) {
  std::vector<Check> failed;
  std::ranges::copy_if(checks, std::back_inserter(failed),
                       [](const Check& c) { return !c.holds(); });
  return failed;
}

std::string format_checks(const std::vector<Check>& checks) {
  const std::size_t what = widest(checks, &Check::what);
  const std::size_t measured = widest(checks, &Check::measured);
  const std::size_t expected = widest(checks, &Check::expected);
  const bool kinds = std::ranges::any_of(
      checks, [](const Check& check) { return check.kind != CheckKind::kExpectation; });
  std::string text;
  for (const Check& check : checks) {
    text += kinds ? fmt::format("  {:<11}", name_of(check.kind)) : "";
    text += fmt::format("  {:<{}}  {:>{}}  {:<{}}  {}\n", check.what, what, check.measured,
                        measured, check.expected, expected, outcome_of(check));
  }
  return text;
}

}  // namespace vinebench::harness
