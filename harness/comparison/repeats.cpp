// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/comparison/repeats.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "harness/comparison/run_hashes.h"
#include "harness/statistics/shares.h"

namespace vinebench::harness {
namespace {

std::size_t repeats_of(const RepeatedSeed& seed) {
  return seed.runs.repeats.size() + seed.without_results;
}

std::optional<FailingSeed> failing_seed(const RepeatedSeed& seed) {
  FailingSeed found{
      .seed = seed.runs.seed, .failed = seed.without_results, .repeats = repeats_of(seed)};
  std::set<std::string> names;
  for (const StoredRun& run : seed.runs.repeats) {
    const std::vector<Check> failed = failed_of(run.checks);
    found.failed += failed.empty() ? 0 : 1;
    for (const Check& check : failed) names.insert(check.what);
  }
  if (seed.without_results > 0) names.insert("run without results");
  if (found.failed == 0) return std::nullopt;
  found.rate = clopper_pearson(found.failed, found.repeats, 0.05);
  found.checks.assign(names.begin(), names.end());
  return found;
}

/// Values of each seed; logarithms if all are positive and the metric is a ratio's.
std::optional<MetricVariance> variance_of(const Metric& metric,
                                          const std::vector<RepeatedSeed>& seeds) {
  MetricVariance result{.metric = metric, .logarithmic = metric.compared_by == Scale::kRatio};
  std::vector<std::vector<double>> groups;
  for (const RepeatedSeed& seed : seeds) {
    std::vector<double>& group = groups.emplace_back();
    for (const StoredRun& run : seed.runs.repeats) {
      SeedRuns single{.repeats = {run}};
      if (const auto value = value_of(metric, single)) group.push_back(*value);
      if (!group.empty() && group.back() <= 0) result.logarithmic = false;
    }
  }
  if (result.logarithmic) {
    for (auto& group : groups) {
      for (double& value : group) value = std::log(value);
    }
  }
  const auto components = variance_components(groups);
  if (!components) return std::nullopt;
  result.components = *components;
  return result;
}

RepeatsSummary summary_of(const std::vector<RepeatedSeed>& seeds) {
  RepeatsSummary summary{.scenario = seeds.front().runs.scenario, .hashed = true};
  for (const RepeatedSeed& seed : seeds) {
    summary.runs += repeats_of(seed);
    if (repeats_of(seed) < 2) continue;
    ++summary.seeds;
    if (const auto failing = failing_seed(seed)) summary.failing.push_back(*failing);
    const HashComparison hashes = compare_hashes(seed.runs.repeats);
    if (hashes.relation == HashRelation::kUnknown) summary.hashed = false;
    if (hashes.relation == HashRelation::kDiffer) summary.differing.push_back(seed.runs.seed);
    if (!hashes.reason.empty()) summary.not_comparable = hashes.reason;
  }
  for (const Metric& metric : shown_metrics()) {
    if (auto result = variance_of(metric, seeds)) summary.variances.push_back(std::move(*result));
  }
  return summary;
}

/// A standard deviation: a share of the value, or in the metric's unit.
std::string deviation_text(const MetricVariance& result, double variance) {
  const double deviation = std::sqrt(variance);
  return result.logarithmic ? fmt::format("{:.1f} %", 100 * std::expm1(deviation))
                            : fmt::format("{:.{}f}", deviation, result.metric.decimals + 1);
}

std::string variance_table(const std::vector<MetricVariance>& results) {
  std::vector<std::vector<std::string>> rows{
      {"metric", "between repeats", "between seeds", "variance of the system"}};
  for (const MetricVariance& result : results) {
    const VarianceComponents& found = result.components;
    if (found.within + found.between <= 0) continue;
    rows.push_back({result.metric.title, deviation_text(result, found.within),
                    deviation_text(result, found.between),
                    fmt::format("{:.0f} %", 100 * found.share_within())});
  }
  return rows.size() == 1 ? "" : markdown_table(rows, 1);
}

std::string failing_text(const FailingSeed& seed) {
  return fmt::format("  seed {}: {}, {} of {} repeats fail ({:.0f} .. {:.0f} %): {}\n", seed.seed,
                     seed.broken() ? "broken" : "flaky", seed.failed, seed.repeats,
                     100 * seed.rate.low, 100 * seed.rate.high, fmt::join(seed.checks, ", "));
}

std::string hash_text(const RepeatsSummary& summary) {
  if (summary.deterministic()) {
    return "repeats agree by hash: the system is deterministic here, and one run of a seed is "
           "enough";
  }
  if (!summary.differing.empty()) {
    return fmt::format("repeats differ by hash in seed {}: the system is not deterministic",
                       fmt::join(summary.differing, ", "));
  }
  if (!summary.hashed) return "runs without a hash";
  return "hashes are not comparable: " + summary.not_comparable;
}

}  // namespace

std::vector<RepeatsSummary> summarise_repeats(const std::vector<RepeatedSeed>& seeds) {
  std::vector<RepeatsSummary> summaries;
  std::vector<std::string> scenarios;
  for (const RepeatedSeed& seed : seeds) {
    if (std::ranges::count(scenarios, seed.runs.scenario) == 0) {
      scenarios.push_back(seed.runs.scenario);
    }
  }
  for (const std::string& scenario : scenarios) {
    std::vector<RepeatedSeed> own;
    std::ranges::copy_if(seeds, std::back_inserter(own),
                         [&](const RepeatedSeed& seed) { return seed.runs.scenario == scenario; });
    RepeatsSummary summary = summary_of(own);
    if (summary.seeds > 0) summaries.push_back(std::move(summary));
  }
  return summaries;
}

std::string format_repeats(const std::vector<RepeatsSummary>& summaries) {
  std::string text;
  for (const RepeatsSummary& summary : summaries) {
    text += fmt::format("{}, repeats of {} seeds: {}\n", summary.scenario, summary.seeds,
                        hash_text(summary));
    for (const FailingSeed& seed : summary.failing) text += failing_text(seed);
    if (summary.deterministic()) continue;
    const std::string table = variance_table(summary.variances);
    if (!table.empty()) text += "\n" + table + "\n";
  }
  return text;
}

Json repeats_json(const std::vector<RepeatsSummary>& summaries) {
  Json list = Json::array();
  for (const RepeatsSummary& summary : summaries) {
    Json failing = Json::array();
    for (const FailingSeed& seed : summary.failing) {
      failing.push_back({{"seed", seed.seed},
                         {"state", seed.broken() ? "broken" : "flaky"},
                         {"failed", seed.failed},
                         {"repeats", seed.repeats},
                         {"failure_rate_95", {seed.rate.low, seed.rate.high}},
                         {"expectations", seed.checks}});
    }
    Json results = Json::array();
    for (const auto& [metric, logarithmic, found] : summary.variances) {
      results.push_back({{"metric", metric.title},
                         {"key", name_of(metric)},
                         {"logarithmic", logarithmic},
                         {"seeds", found.groups},
                         {"values", found.values},
                         {"variance_between_repeats", found.within},
                         {"variance_between_seeds", found.between},
                         {"mean_square_within", found.mean_square_within},
                         {"mean_square_between", found.mean_square_between},
                         {"f", found.f ? Json(*found.f) : Json()},
                         {"p", found.p ? Json(*found.p) : Json()},
                         {"share_of_repeats", found.share_within()}});
    }
    list.push_back({{"scenario", summary.scenario},
                    {"seeds", summary.seeds},
                    {"runs", summary.runs},
                    {"deterministic", summary.deterministic()},
                    {"differing_seeds", summary.differing},
                    {"hashes_not_comparable", summary.not_comparable},
                    {"failing", failing},
                    {"metrics", results}});
  }
  return list;
}

}  // namespace vinebench::harness
