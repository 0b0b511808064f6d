// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/comparison/compare.h"

#include <algorithm>
#include <cmath>

#include "harness/comparison/run_hashes.h"
#include "harness/statistics/holm.h"

namespace vinebench::harness {
namespace {

/// Positive values are needed for ratios; a margin in the metric's unit asks for differences.
Method method_of(const MetricComparison& result, const Margin& margin) {
  if (result.metric.compared_by == Scale::kOrdered) return Method::kOrdered;
  const auto positive = [](double value) { return value > 0; };
  if (margin.absolute) return Method::kDifference;
  return std::ranges::all_of(result.before, positive) && std::ranges::all_of(result.after, positive)
             ? Method::kRatio
             : Method::kOrdered;
}

double mean_for(Method method, const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += method == Method::kRatio ? std::log(value) : value;
  const double mean = sum / static_cast<double>(values.size());
  return method == Method::kRatio ? std::exp(mean) : mean;
}

void count_ordered(MetricComparison& result) {
  for (const double difference : result.differences) {
    ++(difference > result.tolerance    ? result.counts.more
       : difference < -result.tolerance ? result.counts.less
                                        : result.counts.same);
  }
}

void test_ordered(MetricComparison& result, const Margin& margin, double alpha) {
  result.margin = margin.share;
  result.tolerance = margin.absolute.value_or(result.metric.tolerance);
  count_ordered(result);
  result.effect = result.counts.net_share();
  result.interval = interval_of(result.counts, alpha);
  result.p_difference = p_of_no_difference(result.counts);
  result.p_equivalence = p_of_no_equivalence(result.counts, result.margin);
}

void test_mean(MetricComparison& result, const Margin& margin, double alpha) {
  result.margin =
      result.method == Method::kRatio ? std::log1p(margin.share) : margin.absolute.value();
  result.effect = result.sample.mean;
  if (result.sample.has_spread()) result.interval = interval_of(result.sample, alpha);
  result.p_difference = p_of_no_difference(result.sample);
  result.p_equivalence = p_of_no_equivalence(result.sample, result.margin);
}

MetricComparison comparison_of(const Metric& metric, const std::vector<RunPair>& pairs,
                               const CompareSettings& settings) {
  MetricComparison result{.metric = metric};
  for (const RunPair& pair : pairs) {
    const auto before = value_of(metric, pair.before);
    const auto after = value_of(metric, pair.after);
    if (!before || !after) continue;
    result.before.push_back(*before);
    result.after.push_back(*after);
  }
  if (result.before.empty()) return result;
  const Margin margin = settings.margins.of(metric);
  result.method = method_of(result, margin);
  for (std::size_t i = 0; i < result.before.size(); ++i) {
    result.differences.push_back(result.method == Method::kRatio
                                     ? std::log(result.after[i] / result.before[i])
                                     : result.after[i] - result.before[i]);
  }
  result.mean_before = mean_for(result.method, result.before);
  result.mean_after = mean_for(result.method, result.after);
  result.sample = paired_mean(result.differences);
  const auto test = result.method == Method::kOrdered ? test_ordered : test_mean;
  test(result, margin, settings.goal.alpha);
  return result;
}

bool never_differs(const MetricComparison& result) {
  return result.method == Method::kOrdered
             ? result.counts.more + result.counts.less == 0
             : std::ranges::all_of(result.differences, [](double d) { return d == 0; });
}

/// Holm's correction within the estimate's metrics, or within those of the cost. Metrics that never
/// differ cannot be said to differ, whatever their signs, and need no share of alpha there (Tarone
/// 1990, Biometrics 46:515).
void adjust(std::vector<MetricComparison>& results, bool of_estimate, double alpha) {
  std::vector<MetricComparison*> family;
  std::vector<MetricComparison*> differing;
  for (MetricComparison& result : results) {
    if (result.metric.of_estimate != of_estimate) continue;
    family.push_back(&result);
    if (!never_differs(result)) differing.push_back(&result);
  }
  const auto adjust_p = [](const std::vector<MetricComparison*>& those, auto from, auto to) {
    std::vector<double> p_values;
    for (const MetricComparison* result : those) p_values.push_back(result->*from);
    const std::vector<double> adjusted = holm_adjusted(p_values);
    for (std::size_t i = 0; i < those.size(); ++i) those[i]->*to = adjusted[i];
  };
  adjust_p(differing, &MetricComparison::p_difference, &MetricComparison::adjusted_p_difference);
  adjust_p(family, &MetricComparison::p_equivalence, &MetricComparison::adjusted_p_equivalence);
  for (MetricComparison* result : family) {
    result->level = alpha / static_cast<double>(family.size());
  }
}

Verdict verdict_of(const MetricComparison& result, double alpha) {
  if (result.adjusted_p_equivalence <= alpha) return Verdict::kEqual;
  if (result.adjusted_p_difference > alpha) return Verdict::kCannotTell;
  return (result.effect > 0) == result.metric.larger_is_better ? Verdict::kBetter : Verdict::kWorse;
}

using Count = std::optional<std::size_t>;

Count smaller(const Count& a, const Count& b) {
  return a && b ? std::min(a, b) : a ? a : b;
}

Count larger(const Count& a, const Count& b) {
  return a && b ? std::max(a, b) : std::nullopt;
}

/// The measured effect with its standard error on either side, without its sign. Power by the
/// effect as measured would only restate its p-value (Hoenig and Heisey 2001, Am. Stat. 55:19).
Interval likely_effect(const MetricComparison& result, double spread) {
  const double error = spread / std::sqrt(static_cast<double>(result.pairs()));
  return {std::abs(result.effect) - error, std::abs(result.effect) + error};
}

/// By the measured spread: enough to detect an effect that is likely above the margin, or to show
/// equality of one that is likely below it; else enough for either truth, no difference or one of
/// the margin's size. Where that many pairs are there already, the measured effect counts.
Count needed_for_mean(const MetricComparison& result, const TestGoal& goal) {
  const double spread = result.sample.spread;
  if (!result.sample.has_spread() || spread == 0) return std::nullopt;
  const Interval likely = likely_effect(result, spread);
  const double margin = result.margin / spread;
  const Count planned =
      likely.low > result.margin ? pairs_to_detect(likely.low / spread, goal)
      : likely.high < result.margin
          ? pairs_to_show_equal(margin, likely.high / spread, goal)
          : larger(pairs_to_detect(margin, goal), pairs_to_show_equal(margin, 0, goal));
  if (!planned || *planned > result.pairs()) return planned;
  const double measured = std::abs(result.effect) / spread;
  return smaller(pairs_to_detect(measured, goal), pairs_to_show_equal(margin, measured, goal));
}

/// Rates that differ by the effect, of which the smaller is `chance` or less.
PairRates rates_of(double effect, double chance) {
  const double less = std::min(chance, (1 - effect) / 2);
  return {less + effect, less};
}

/// The same for shares of the pairs. Where a difference is detected, what is rarer is chance; where
/// none is assumed, all that differs is.
Count needed_for_ordered(const MetricComparison& result, const TestGoal& goal) {
  const auto n = static_cast<double>(result.pairs());
  const PairRates found{static_cast<double>(result.counts.more) / n,
                        static_cast<double>(result.counts.less) / n};
  const double differing = found.more + found.less;
  const double spread = std::sqrt(std::max(0.0, differing - result.effect * result.effect));
  const Interval likely = likely_effect(result, spread);
  const Count equal = pairs_to_show_equal(found, result.margin, goal);
  const Count either = larger(pairs_to_detect(rates_of(result.margin, differing / 2), goal),
                              pairs_to_show_equal(rates_of(0, differing / 2), result.margin, goal));
  const Count planned =
      likely.low > result.margin
          ? pairs_to_detect(rates_of(likely.low, std::min(found.more, found.less)), goal)
      : likely.high < result.margin && equal ? equal
      : either                               ? either
               : pairs_to_detect(rates_of(result.margin, differing / 2), goal);
  if (!planned || *planned > result.pairs()) return planned;
  return smaller(pairs_to_detect(found, goal), equal);
}

void decide(MetricComparison& result, const TestGoal& goal) {
  result.verdict = verdict_of(result, goal.alpha);
  if (result.verdict != Verdict::kCannotTell) return;
  const TestGoal single{.alpha = result.level, .power = goal.power};
  result.needed = result.method == Method::kOrdered ? needed_for_ordered(result, single)
                                                    : needed_for_mean(result, single);
  if (result.needed) result.needed = std::max(*result.needed, result.pairs() + 1);
}

}  // namespace

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::kBetter:
      return "better";
    case Verdict::kWorse:
      return "worse";
    case Verdict::kEqual:
      return "equal";
    case Verdict::kCannotTell:
      return "cannot tell yet";
    case Verdict::kMixed:
      return "mixed";
  }
  return "";
}

std::vector<Metric> metrics_of(const CompareSettings& settings) {
  return settings.metrics.empty() ? parse_metrics({}) : settings.metrics;
}

const char* name_of(Method method) {
  switch (method) {
    case Method::kRatio:
      return "ratio";
    case Method::kDifference:
      return "difference";
    case Method::kOrdered:
      return "ordered";
  }
  return "";
}

std::vector<MetricComparison> compare_metrics(const std::vector<RunPair>& pairs,
                                              const CompareSettings& settings) {
  std::vector<MetricComparison> results;
  for (const Metric& metric : metrics_of(settings)) {
    MetricComparison result = comparison_of(metric, pairs, settings);
    if (result.pairs() > 0) results.push_back(std::move(result));
  }
  for (const bool of_estimate : {true, false}) adjust(results, of_estimate, settings.goal.alpha);
  const bool same = compare_hashes(pairs).relation == HashRelation::kSame;
  for (MetricComparison& result : results) {
    if (same && result.metric.of_estimate && never_differs(result)) {
      result.p_equivalence = result.adjusted_p_equivalence = 0;
      result.interval = {0, 0};
    }
    decide(result, settings.goal);
  }
  return results;
}

Verdict overall(const std::vector<MetricComparison>& results) {
  const auto any = [&](Verdict verdict) {
    return std::ranges::any_of(results, [&](const MetricComparison& result) {
      return result.metric.of_estimate && result.verdict == verdict;
    });
  };
  if (any(Verdict::kBetter) && any(Verdict::kWorse)) return Verdict::kMixed;
  if (any(Verdict::kBetter)) return Verdict::kBetter;
  if (any(Verdict::kWorse)) return Verdict::kWorse;
  if (any(Verdict::kCannotTell)) return Verdict::kCannotTell;
  return any(Verdict::kEqual) ? Verdict::kEqual : Verdict::kCannotTell;
}

}  // namespace vinebench::harness
