// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/comparison/seed_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/util/error.h"

namespace vinebench::harness {
namespace {

/// Measured values by scenario, whose means have nothing to do with each other.
using Values = std::map<std::string, std::vector<double>>;

bool all_positive(const Values& values) {
  return std::ranges::all_of(values, [](const auto& scenario) {
    return std::ranges::all_of(scenario.second, [](double value) { return value > 0; });
  });
}

Method planned_method(const Metric& metric, const Margin& margin, bool positive) {
  if (metric.compared_by == Scale::kOrdered) return Method::kOrdered;
  return margin.absolute ? Method::kDifference : positive ? Method::kRatio : Method::kOrdered;
}

/// Standard deviation within the scenarios; empty if none has two values.
std::optional<double> pooled_spread(const Values& values) {
  double squares = 0;
  double degrees = 0;
  for (const auto& [scenario, own] : values) {
    if (own.size() < 2) continue;
    const PairedMean sample = paired_mean(own);
    const auto free = static_cast<double>(own.size() - 1);
    squares += free * sample.spread * sample.spread;
    degrees += free;
  }
  if (degrees == 0 || !std::isfinite(squares)) return std::nullopt;
  return std::sqrt(squares / degrees);
}

/// Share of the ordered pairs of two runs of a scenario of which the first has more.
std::optional<double> chance_of_more(const Values& values, double tolerance) {
  double more = 0;
  double pairs = 0;
  for (const auto& [scenario, own] : values) {
    for (std::size_t i = 0; i < own.size(); ++i) {
      for (std::size_t j = 0; j < own.size(); ++j) {
        more += i != j && own[i] - own[j] > tolerance ? 1 : 0;
        pairs += i != j ? 1 : 0;
      }
    }
  }
  return pairs > 0 ? std::optional(more / pairs) : std::nullopt;
}

/// The effect and the numbers of pairs by a spread or a rate that is known.
MetricPlan completed(MetricPlan plan, const Margin& margin, const TestGoal& goal) {
  const TestGoal single{.alpha = plan.level, .power = goal.power};
  if (plan.method == Method::kOrdered) {
    plan.effect = margin.share;
    plan.rate = std::min(plan.rate, (1 - plan.effect) / 2);
    plan.to_detect = pairs_to_detect(PairRates{plan.rate + plan.effect, plan.rate}, single);
    plan.to_show_equal = pairs_to_show_equal(PairRates{plan.rate, plan.rate}, plan.effect, single);
    return plan;
  }
  plan.effect = plan.method == Method::kRatio ? std::log1p(margin.share) : margin.absolute.value();
  const double effect = plan.effect / std::max(plan.spread, 1e-6 * plan.effect);
  plan.to_detect = pairs_to_detect(effect, single);
  plan.to_show_equal = pairs_to_show_equal(effect, 0, single);
  return plan;
}

/// Plans of the metrics that were measured; `measure` fills in the spread or the rate.
template <class Measure>
std::vector<MetricPlan> planned(const CompareSettings& settings, const Measure& measure) {
  std::vector<MetricPlan> plans;
  for (const Metric& metric : metrics_of(settings)) {
    MetricPlan plan{.metric = metric};
    if (measure(plan, settings.margins.of(metric))) plans.push_back(plan);
  }
  if (plans.empty())
    fail("expected runs of at least two seeds of a scenario, to measure the spread");
  for (MetricPlan& plan : plans) {
    const auto family = std::ranges::count_if(plans, [&](const MetricPlan& other) {
      return other.metric.of_estimate == plan.metric.of_estimate;
    });
    plan.level = settings.goal.alpha / static_cast<double>(family);
    plan = completed(plan, settings.margins.of(plan.metric), settings.goal);
  }
  return plans;
}

bool measure_pairs(MetricPlan& plan, const Margin& margin, const std::vector<RunPair>& pairs) {
  std::vector<std::pair<double, double>> values;
  for (const RunPair& pair : pairs) {
    const auto before = value_of(plan.metric, pair.before);
    const auto after = value_of(plan.metric, pair.after);
    if (before && after) values.emplace_back(*before, *after);
  }
  plan.seeds = values.size();
  if (values.size() < 2) return false;
  const bool positive = std::ranges::all_of(
      values, [](const auto& pair) { return pair.first > 0 && pair.second > 0; });
  plan.method = planned_method(plan.metric, margin, positive);
  std::vector<double> differences;
  std::size_t differing = 0;
  const double tolerance = margin.absolute.value_or(plan.metric.tolerance);
  for (const auto& [before, after] : values) {
    differences.push_back(plan.method == Method::kRatio ? std::log(after / before)
                                                        : after - before);
    differing += std::abs(after - before) > tolerance ? 1 : 0;
  }
  plan.rate = static_cast<double>(differing) / static_cast<double>(2 * values.size());
  plan.spread = paired_mean(differences).spread;
  return std::isfinite(plan.spread);
}

bool measure_set(MetricPlan& plan, const Margin& margin, const std::vector<SeedRuns>& runs) {
  Values values;
  for (const SeedRuns& seed : runs) {
    const auto value = value_of(plan.metric, seed);
    if (!value) continue;
    values[seed.scenario].push_back(*value);
    ++plan.seeds;
  }
  plan.method = planned_method(plan.metric, margin, all_positive(values));
  if (plan.method == Method::kOrdered) {
    const auto rate = chance_of_more(values, margin.absolute.value_or(plan.metric.tolerance));
    plan.rate = rate.value_or(0);
    return rate.has_value();
  }
  if (plan.method == Method::kRatio) {
    for (auto& [scenario, own] : values) {
      for (double& value : own) value = std::log(value);
    }
  }
  const auto spread = pooled_spread(values);
  plan.spread = std::sqrt(2.0) * spread.value_or(0);
  return spread.has_value();
}

std::string spread_text(const MetricPlan& plan) {
  switch (plan.method) {
    case Method::kRatio:
      return fmt::format("{:.1f} %", 100 * std::expm1(plan.spread));
    case Method::kDifference:
      return fmt::format("{:.{}f}", plan.spread, plan.metric.decimals + 1);
    case Method::kOrdered:
      return fmt::format("{:.0f} % of seeds", 200 * plan.rate);
  }
  return "";
}

std::string detected_text(const MetricPlan& plan) {
  switch (plan.method) {
    case Method::kRatio:
      return fmt::format("{:g} %", std::round(1e6 * std::expm1(plan.effect)) / 1e4);
    case Method::kDifference:
      return fmt::format("{:g}", plan.effect);
    case Method::kOrdered:
      return fmt::format("{:g} % of seeds", 100 * plan.effect);
  }
  return "";
}

std::string needed_text(const std::optional<std::size_t>& pairs) {
  return pairs ? std::to_string(*pairs) : fmt::format("> {}", kMostPairs);
}

Json needed_json(const std::optional<std::size_t>& pairs) {
  return pairs ? Json(*pairs) : Json();
}

}  // namespace

std::vector<MetricPlan> plan_seeds(const std::vector<RunPair>& pairs,
                                   const CompareSettings& settings) {
  return planned(settings, [&](MetricPlan& plan, const Margin& margin) {
    return measure_pairs(plan, margin, pairs);
  });
}

std::vector<MetricPlan> plan_seeds(const std::vector<SeedRuns>& runs,
                                   const CompareSettings& settings) {
  return planned(settings, [&](MetricPlan& plan, const Margin& margin) {
    return measure_set(plan, margin, runs);
  });
}

std::string format_plan(const std::vector<MetricPlan>& plans, const CompareSettings& settings) {
  std::vector<std::vector<std::string>> rows{{"metric", "measured seeds", "spread of a pair",
                                              "change", "to detect it", "to show less than it"}};
  for (const MetricPlan& plan : plans) {
    rows.push_back({plan.metric.title, std::to_string(plan.seeds), spread_text(plan),
                    detected_text(plan), needed_text(plan.to_detect),
                    needed_text(plan.to_show_equal)});
  }
  return markdown_table(rows, 1) +
         fmt::format("seeds for a power of {:g} %, at alpha = {:g} for all metrics together\n",
                     100 * settings.goal.power, settings.goal.alpha);
}

Json plan_json(const std::vector<MetricPlan>& plans, const CompareSettings& settings) {
  Json list = Json::array();
  for (const MetricPlan& plan : plans) {
    list.push_back({{"metric", plan.metric.title},
                    {"key", name_of(plan.metric)},
                    {"method", name_of(plan.method)},
                    {"measured_seeds", plan.seeds},
                    {"spread", plan.spread},
                    {"rate", plan.rate},
                    {"change", plan.effect},
                    {"level", plan.level},
                    {"seeds_to_detect", needed_json(plan.to_detect)},
                    {"seeds_to_show_equal", needed_json(plan.to_show_equal)}});
  }
  return {{"alpha", settings.goal.alpha}, {"power", settings.goal.power}, {"metrics", list}};
}

}  // namespace vinebench::harness
