// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sets/set_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "core/util/percentile.h"

namespace vinebench::harness {
namespace {

std::optional<double> value_of(const Metric& metric, const SetRun& run) {
  return run.result ? value_of(metric, *run.result) : std::nullopt;
}

/// Values by seed, each with those of its repeats.
using SeedValues = std::map<std::int64_t, std::vector<double>>;

/// Over the seeds' own medians; empty without values.
std::optional<double> median_of(const SeedValues& seeds) {
  std::vector<double> values;
  for (const auto& [seed, repeats] : seeds) values.push_back(percentile(repeats, 0.5));
  return values.empty() ? std::nullopt : std::optional(percentile(values, 0.5));
}

std::vector<std::optional<double>> medians_of(const std::vector<SetRun>& runs) {
  std::vector<std::optional<double>> medians;
  for (const Metric& metric : shown_metrics()) {
    SeedValues values;
    for (const SetRun& run : runs) {
      if (const auto value = value_of(metric, run)) values[run.seed].push_back(*value);
    }
    medians.push_back(median_of(values));
  }
  return medians;
}

std::size_t seeds_of(const std::vector<SetRun>& runs) {
  SeedValues seeds;
  for (const SetRun& run : runs) seeds[run.seed];
  return seeds.size();
}

void check_median(const std::vector<SetRun>& runs, const char* key, const char* what,
                  const std::optional<double>& bound, std::vector<Check>& checks) {
  if (!bound) return;
  SeedValues errors;
  for (const SetRun& run : runs) {
    const auto error = run.result ? run.result->value(key) : std::nullopt;
    errors[run.seed].push_back(error.value_or(std::numeric_limits<double>::max()));
  }
  const double median = median_of(errors).value();
  const bool known = median < std::numeric_limits<double>::max() / 4;
  checks.push_back({fmt::format("median of {} seeds: {}", errors.size(), what),
                    known ? fmt::format("{:.4f} m", median) : "none",
                    fmt::format("<= {:.4f} m", *bound), median <= *bound});
}

void check_medians(const Expectations& expectations, CheckKind kind,
                   const std::vector<SetRun>& runs, std::vector<Check>& checks) {
  if (!expectations.median || seeds_of(runs) < kSeedsForMedian) return;
  const std::size_t first = checks.size();
  check_median(runs, "/ate_rmse_m", "ATE, SE(3)-aligned", expectations.median->ate_rmse_max,
               checks);
  check_median(runs, "/ate_origin_rmse_m", "ATE, first pose aligned",
               expectations.median->ate_origin_rmse_max, checks);
  for (std::size_t i = first; i < checks.size(); ++i) checks[i].kind = kind;
}

std::optional<RepeatsSummary> repeats_of(const std::vector<SetRun>& runs) {
  std::vector<RepeatedSeed> seeds;
  for (const SetRun& run : runs) {
    if (seeds.empty() || seeds.back().runs.seed != run.seed) {
      seeds.push_back({.runs = {.scenario = run.scenario, .seed = run.seed}});
    }
    if (run.result) {
      seeds.back().runs.repeats.push_back(*run.result);
    } else {
      ++seeds.back().without_results;
    }
  }
  const std::vector<RepeatsSummary> summaries = summarise_repeats(seeds);
  return summaries.empty() ? std::nullopt : std::optional(summaries.front());
}

/// The built-in system gives the same bytes each time; of others nobody promises that.
std::vector<Check> check_repeats(const SlamChoice& slam,
                                 const std::optional<RepeatsSummary>& repeats) {
  if (!repeats || !slam.is_core()) return {};
  const std::size_t differing = repeats->differing.size();
  const std::string& obstacle = repeats->not_comparable;
  return {{"repeats agree by hash",
           obstacle.empty() ? fmt::format("{} seeds differ", differing) : obstacle,
           "0 seeds differ", differing == 0 && obstacle.empty()}};
}

bool is_shown(const Metric& metric, TableColumns columns) {
  return columns == TableColumns::kAll || metric.of_estimate;
}

std::vector<std::string> cells_of(const std::vector<std::optional<double>>& values,
                                  TableColumns columns) {
  std::vector<std::string> cells;
  for (std::size_t i = 0; i < shown_metrics().size(); ++i) {
    const Metric& metric = shown_metrics()[i];
    if (is_shown(metric, columns)) cells.push_back(format_value(metric, values[i]));
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

/// "3", of several repeats "3 (2)".
std::string cell_of_seed(const SetRun& run) {
  return run.repeats > 1 ? fmt::format("{} ({})", run.seed, run.repeat) : std::to_string(run.seed);
}

std::vector<std::string> header(TableColumns columns) {
  std::vector<std::string> titles;
  for (const Metric& metric : shown_metrics()) {
    if (is_shown(metric, columns)) titles.push_back(metric.title);
  }
  return row_of("scenario", "seed", titles, "verdict");
}

}  // namespace

std::string verdict_of(const SetRun& run) {
  if (run.missing) return "missing";
  if (!run.error.empty()) return "ERROR";
  if (run.failed()) return verdict_of(run.result->checks);
  return run.result && goal_open(run.result->checks) ? "passed (goal open)" : "passed";
}

bool SeedsSummary::passed() const {
  return all_hold(checks) && all_hold(repeat_checks) && std::ranges::all_of(runs, &SetRun::passed);
}

std::vector<SeedsSummary> summarise(const std::vector<PlannedRun>& plan, SetOutcome outcome) {
  std::vector<SeedsSummary> scenarios;
  std::map<std::string, const ScenarioConfig*> settings;
  for (const PlannedRun& run : plan) settings.emplace(run.title, run.settings.get());
  for (SetRun& run : outcome.runs) {
    if (scenarios.empty() || scenarios.back().scenario != run.scenario) {
      scenarios.push_back({.scenario = run.scenario});
    }
    scenarios.back().runs.push_back(std::move(run));
  }
  for (SeedsSummary& summary : scenarios) {
    summary.medians = medians_of(summary.runs);
    const ScenarioConfig& scenario = *settings.at(summary.scenario);
    check_medians(scenario.expectations, CheckKind::kExpectation, summary.runs, summary.checks);
    check_medians(scenario.goal, CheckKind::kGoal, summary.runs, summary.checks);
    check_medians(scenario.now, CheckKind::kNow, summary.runs, summary.checks);
    mark_open_goals(summary.checks);
    summary.repeats = repeats_of(summary.runs);
    summary.repeat_checks = check_repeats(scenario.slam, summary.repeats);
  }
  return scenarios;
}

std::string format_table(const std::vector<SeedsSummary>& scenarios, TableColumns columns) {
  std::vector<std::vector<std::string>> rows{header(columns)};
  for (const SeedsSummary& summary : scenarios) {
    for (const SetRun& run : summary.runs) {
      std::vector<std::optional<double>> values;
      for (const Metric& metric : shown_metrics()) values.push_back(value_of(metric, run));
      rows.push_back(
          row_of(summary.scenario, cell_of_seed(run), cells_of(values, columns), verdict_of(run)));
    }
    if (summary.runs.size() > 1) {
      const std::string verdict = summary.passed() ? "passed" : "FAILED";
      rows.push_back(
          row_of(summary.scenario, "median", cells_of(summary.medians, columns), verdict));
    }
  }
  return markdown_table(rows, 2);
}

std::string format_repeats(const std::vector<SeedsSummary>& scenarios) {
  std::vector<RepeatsSummary> summaries;
  for (const SeedsSummary& summary : scenarios) {
    if (summary.repeats) summaries.push_back(*summary.repeats);
  }
  return format_repeats(summaries);
}

std::string format_failures(const std::vector<SeedsSummary>& scenarios) {
  std::string text;
  std::error_code ignored;
  for (const SeedsSummary& summary : scenarios) {
    for (const SetRun& run : summary.runs) {
      if (!run.error.empty()) {
        const std::filesystem::path log = run.folder / "log.txt";
        const bool logged = std::filesystem::is_regular_file(log, ignored);
        text += fmt::format("{}, {}: {}{}\n", run.scenario,
                            seed_text(run.seed, run.repeat, run.repeats), run.error,
                            logged ? "; see " + log.string() : "");
      } else if (run.failed()) {
        text += fmt::format("{}, {} ({}):\n{}", run.scenario,
                            seed_text(run.seed, run.repeat, run.repeats), run.folder.string(),
                            format_checks(failed_of(run.result->checks)));
      }
    }
    for (const std::vector<Check>* checks : {&summary.checks, &summary.repeat_checks}) {
      if (all_hold(*checks)) continue;
      text += fmt::format("{}:\n{}", summary.scenario, format_checks(failed_of(*checks)));
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
                      {"repeat", run.repeat},
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
    list.push_back(
        {{"scenario", summary.scenario},
         {"passed", summary.passed()},
         {"median", medians},
         {"expectations_of_median", checks_json(summary.checks)},
         {"expectations_of_repeats", checks_json(summary.repeat_checks)},
         {"repeats", summary.repeats ? repeats_json({*summary.repeats}).front() : Json()},
         {"runs", runs}});
  }
  return {{"passed", std::ranges::all_of(scenarios, &SeedsSummary::passed)}, {"scenarios", list}};
}

}  // namespace vinebench::harness
