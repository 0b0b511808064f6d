// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sets/set_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/util/percentile.h"

namespace vinebench::harness {
namespace {

std::string verdict_of(const SetRun& run) {
  return !run.error.empty() ? "ERROR" : run.failed() ? verdict_of(run.result->checks) : "passed";
}

std::optional<double> value_of(const Metric& metric, const SetRun& run) {
  return run.result ? value_of(metric, *run.result) : std::nullopt;
}

std::vector<std::optional<double>> medians_of(const std::vector<SetRun>& runs) {
  std::vector<std::optional<double>> medians;
  for (const Metric& metric : shown_metrics()) {
    std::vector<double> values;
    for (const SetRun& run : runs) {
      if (const auto value = value_of(metric, run)) values.push_back(*value);
    }
    medians.push_back(values.empty() ? std::nullopt : std::optional(percentile(values, 0.5)));
  }
  return medians;
}

void check_median(const std::vector<SetRun>& runs, const char* key, const char* what,
                  const std::optional<double>& bound, std::vector<Check>& checks) {
  if (!bound) return;
  std::vector<double> errors;
  for (const SetRun& run : runs) {
    const auto error = run.result ? run.result->value(key) : std::nullopt;
    errors.push_back(error.value_or(std::numeric_limits<double>::max()));
  }
  const double median = percentile(errors, 0.5);
  const bool known = median < std::numeric_limits<double>::max() / 4;
  checks.push_back({fmt::format("median of {} seeds: {}", runs.size(), what),
                    known ? fmt::format("{:.4f} m", median) : "none",
                    fmt::format("<= {:.4f} m", *bound), median <= *bound});
}

void check_medians(const Expectations& expectations, CheckKind kind,
                   const std::vector<SetRun>& runs, std::vector<Check>& checks) {
  if (!expectations.median || runs.size() < kSeedsForMedian) return;
  const std::size_t first = checks.size();
  check_median(runs, "/ate_rmse_m", "ATE, SE(3)-aligned", expectations.median->ate_rmse_max,
               checks);
  check_median(runs, "/ate_origin_rmse_m", "ATE, first pose aligned",
               expectations.median->ate_origin_rmse_max, checks);
  for (std::size_t i = first; i < checks.size(); ++i) checks[i].kind = kind;
}

std::vector<std::string> cells_of(const std::vector<std::optional<double>>& values) {
  std::vector<std::string> cells;
  for (std::size_t i = 0; i < shown_metrics().size(); ++i) {
    cells.push_back(format_value(shown_metrics()[i], values[i]));
  }
  return cells;
}

std::vector<std::string> row_of(const std::string& scenario, const std::string& seed,
                                const std::vector<std::string>& cells, const std::string& verdict) {
  std::vector<std::string> row{scenario, seed};
  row.insert(row.end(), cells.begin(), cells.end());
  row.push_back(verdict);
  return row;
}

std::vector<std::string> header() {
  std::vector<std::string> titles;
  for (const Metric& metric : shown_metrics()) titles.push_back(metric.title);
  return row_of("scenario", "seed", titles, "verdict");
}

}  // namespace

bool SeedsSummary::passed() const {
  return all_hold(checks) && std::ranges::all_of(runs, [](const SetRun& run) {
           return run.error.empty() && !run.failed();
         });
}

std::vector<SeedsSummary> summarise(const std::vector<PlannedRun>& plan,
                                    const SetOutcome& outcome) {
  std::vector<SeedsSummary> scenarios;
  for (const SetRun& run : outcome.runs) {
    if (scenarios.empty() || scenarios.back().scenario != run.scenario) {
      scenarios.push_back({.scenario = run.scenario});
    }
    scenarios.back().runs.push_back(run);
  }
  for (SeedsSummary& summary : scenarios) {
    const auto planned = std::ranges::find_if(
        plan, [&](const PlannedRun& run) { return run.scenario.name == summary.scenario; });
    summary.medians = medians_of(summary.runs);
    const ScenarioConfig& scenario = planned->scenario;
    check_medians(scenario.expectations, CheckKind::kExpectation, summary.runs, summary.checks);
    check_medians(scenario.goal, CheckKind::kGoal, summary.runs, summary.checks);
  }
  return scenarios;
}

std::string format_table(const std::vector<SeedsSummary>& scenarios) {
  std::vector<std::vector<std::string>> rows{header()};
  for (const SeedsSummary& summary : scenarios) {
    for (const SetRun& run : summary.runs) {
      std::vector<std::optional<double>> values;
      for (const Metric& metric : shown_metrics()) values.push_back(value_of(metric, run));
      rows.push_back(
          row_of(summary.scenario, std::to_string(run.seed), cells_of(values), verdict_of(run)));
    }
    if (summary.runs.size() > 1) {
      const std::string verdict = summary.passed() ? "passed" : "FAILED";
      rows.push_back(row_of(summary.scenario, "median", cells_of(summary.medians), verdict));
    }
  }
  return markdown_table(rows, 2);
}

std::string format_failures(const std::vector<SeedsSummary>& scenarios) {
  std::string text;
  std::error_code ignored;
  for (const SeedsSummary& summary : scenarios) {
    for (const SetRun& run : summary.runs) {
      if (!run.error.empty()) {
        const std::filesystem::path log = run.folder / "log.txt";
        const bool logged = std::filesystem::is_regular_file(log, ignored);
        text += fmt::format("{}, seed {}: {}{}\n", run.scenario, run.seed, run.error,
                            logged ? "; see " + log.string() : "");
      } else if (run.failed()) {
        text += fmt::format("{}, seed {} ({}):\n{}", run.scenario, run.seed, run.folder.string(),
                            format_checks(failed_of(run.result->checks)));
      }
    }
    if (!all_hold(summary.checks)) {
      text += fmt::format("{}:\n{}", summary.scenario, format_checks(failed_of(summary.checks)));
    }
  }
  return text;
}

Json summary_json(const std::vector<SeedsSummary>& scenarios) {
  Json list = Json::array();
  for (const SeedsSummary& summary : scenarios) {
    Json runs = Json::array();
    for (const SetRun& run : summary.runs) {
      runs.push_back({{"seed", run.seed},
                      {"folder", run.folder.string()},
                      {"verdict", verdict_of(run)},
                      {"kept", run.kept},
                      {"error", run.error.empty() ? Json() : Json(run.error)},
                      {"metrics", run.result ? run.result->json : Json()}});
    }
    Json medians = Json::object();
    for (std::size_t i = 0; i < shown_metrics().size(); ++i) {
      const auto& value = summary.medians[i];
      medians[shown_metrics()[i].title] = value ? Json(*value) : Json();
    }
    list.push_back({{"scenario", summary.scenario},
                    {"passed", summary.passed()},
                    {"median", medians},
                    {"expectations_of_median", checks_json(summary.checks)},
                    {"runs", runs}});
  }
  return {{"passed", std::ranges::all_of(scenarios, &SeedsSummary::passed)}, {"scenarios", list}};
}

}  // namespace vinebench::harness
