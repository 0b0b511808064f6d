// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/comparison/compare.h"

#include <algorithm>
#include <cmath>

#include "harness/comparison/run_hashes.h"
#include "harness/statistics/holm.h"

namespace vinebench::harness {
namespace {

/// Positive values are needed for ratios; a margin in the figure's unit asks for differences.
Method method_of(const FigureComparison& figure, const Margin& margin) {
  if (figure.metric.compared_by == Scale::kOrdered) return Method::kOrdered;
  const auto positive = [](double value) { return value > 0; };
  if (margin.absolute) return Method::kDifference;
  return std::ranges::all_of(figure.before, positive) && std::ranges::all_of(figure.after, positive)
             ? Method::kRatio
             : Method::kOrdered;
}

double mean_for(Method method, const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += method == Method::kRatio ? std::log(value) : value;
  const double mean = sum / static_cast<double>(values.size());
  return method == Method::kRatio ? std::exp(mean) : mean;
}

void count_ordered(FigureComparison& figure) {
  for (const double difference : figure.differences) {
    ++(difference > figure.tolerance    ? figure.counts.more
       : difference < -figure.tolerance ? figure.counts.less
                                        : figure.counts.same);
  }
}

void test_ordered(FigureComparison& figure, const Margin& margin, double alpha) {
  figure.margin = margin.share;
  figure.tolerance = margin.absolute.value_or(figure.metric.tolerance);
  count_ordered(figure);
  figure.effect = figure.counts.net_share();
  figure.interval = interval_of(figure.counts, alpha);
  figure.p_difference = p_of_no_difference(figure.counts);
  figure.p_equivalence = p_of_no_equivalence(figure.counts, figure.margin);
}

void test_mean(FigureComparison& figure, const Margin& margin, double alpha) {
  figure.margin =
      figure.method == Method::kRatio ? std::log1p(margin.share) : margin.absolute.value();
  figure.effect = figure.sample.mean;
  if (figure.sample.has_spread()) figure.interval = interval_of(figure.sample, alpha);
  figure.p_difference = p_of_no_difference(figure.sample);
  figure.p_equivalence = p_of_no_equivalence(figure.sample, figure.margin);
}

FigureComparison figure_of(const Metric& metric, const std::vector<RunPair>& pairs,
                           const CompareSettings& settings) {
  FigureComparison figure{.metric = metric};
  for (const RunPair& pair : pairs) {
    const auto before = value_of(metric, pair.before);
    const auto after = value_of(metric, pair.after);
    if (!before || !after) continue;
    figure.before.push_back(*before);
    figure.after.push_back(*after);
  }
  if (figure.before.empty()) return figure;
  const Margin margin = settings.margins.of(metric);
  figure.method = method_of(figure, margin);
  for (std::size_t i = 0; i < figure.before.size(); ++i) {
    figure.differences.push_back(figure.method == Method::kRatio
                                     ? std::log(figure.after[i] / figure.before[i])
                                     : figure.after[i] - figure.before[i]);
  }
  figure.mean_before = mean_for(figure.method, figure.before);
  figure.mean_after = mean_for(figure.method, figure.after);
  figure.sample = paired_mean(figure.differences);
  const auto test = figure.method == Method::kOrdered ? test_ordered : test_mean;
  test(figure, margin, settings.goal.alpha);
  return figure;
}

bool never_differs(const FigureComparison& figure) {
  return figure.method == Method::kOrdered
             ? figure.counts.more + figure.counts.less == 0
             : std::ranges::all_of(figure.differences, [](double d) { return d == 0; });
}

/// Holm's correction within the estimate's figures, or within those of the cost. Figures that never
/// differ cannot be said to differ, whatever their signs, and need no share of alpha there (Tarone
/// 1990, Biometrics 46:515).
void adjust(std::vector<FigureComparison>& figures, bool of_estimate, double alpha) {
  std::vector<FigureComparison*> family;
  std::vector<FigureComparison*> differing;
  for (FigureComparison& figure : figures) {
    if (figure.metric.of_estimate != of_estimate) continue;
    family.push_back(&figure);
    if (!never_differs(figure)) differing.push_back(&figure);
  }
  const auto adjust_p = [](const std::vector<FigureComparison*>& those, auto from, auto to) {
    std::vector<double> p_values;
    for (const FigureComparison* figure : those) p_values.push_back(figure->*from);
    const std::vector<double> adjusted = holm_adjusted(p_values);
    for (std::size_t i = 0; i < those.size(); ++i) those[i]->*to = adjusted[i];
  };
  adjust_p(differing, &FigureComparison::p_difference, &FigureComparison::adjusted_p_difference);
  adjust_p(family, &FigureComparison::p_equivalence, &FigureComparison::adjusted_p_equivalence);
  for (FigureComparison* figure : family) {
    figure->level = alpha / static_cast<double>(family.size());
  }
}

Verdict verdict_of(const FigureComparison& figure, double alpha) {
  if (figure.adjusted_p_equivalence <= alpha) return Verdict::kEqual;
  if (figure.adjusted_p_difference > alpha) return Verdict::kCannotTell;
  return (figure.effect > 0) == figure.metric.larger_is_better ? Verdict::kBetter : Verdict::kWorse;
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
Interval likely_effect(const FigureComparison& figure, double spread) {
  const double error = spread / std::sqrt(static_cast<double>(figure.pairs()));
  return {std::abs(figure.effect) - error, std::abs(figure.effect) + error};
}

/// By the measured spread: enough to detect an effect that is likely above the margin, or to show
/// equality of one that is likely below it; else enough for either truth, no difference or one of
/// the margin's size. Where that many pairs are there already, the measured effect counts.
Count needed_for_mean(const FigureComparison& figure, const TestGoal& goal) {
  const double spread = figure.sample.spread;
  if (!figure.sample.has_spread() || spread == 0) return std::nullopt;
  const Interval likely = likely_effect(figure, spread);
  const double margin = figure.margin / spread;
  const Count planned =
      likely.low > figure.margin ? pairs_to_detect(likely.low / spread, goal)
      : likely.high < figure.margin
          ? pairs_to_show_equal(margin, likely.high / spread, goal)
          : larger(pairs_to_detect(margin, goal), pairs_to_show_equal(margin, 0, goal));
  if (!planned || *planned > figure.pairs()) return planned;
  const double measured = std::abs(figure.effect) / spread;
  return smaller(pairs_to_detect(measured, goal), pairs_to_show_equal(margin, measured, goal));
}

/// Rates that differ by the effect, of which the smaller is `chance` or less.
PairRates rates_of(double effect, double chance) {
  const double less = std::min(chance, (1 - effect) / 2);
  return {less + effect, less};
}

/// The same for shares of the pairs. Where a difference is detected, what is rarer is chance; where
/// none is assumed, all that differs is.
Count needed_for_ordered(const FigureComparison& figure, const TestGoal& goal) {
  const auto n = static_cast<double>(figure.pairs());
  const PairRates found{static_cast<double>(figure.counts.more) / n,
                        static_cast<double>(figure.counts.less) / n};
  const double differing = found.more + found.less;
  const double spread = std::sqrt(std::max(0.0, differing - figure.effect * figure.effect));
  const Interval likely = likely_effect(figure, spread);
  const Count equal = pairs_to_show_equal(found, figure.margin, goal);
  const Count either = larger(pairs_to_detect(rates_of(figure.margin, differing / 2), goal),
                              pairs_to_show_equal(rates_of(0, differing / 2), figure.margin, goal));
  const Count planned =
      likely.low > figure.margin
          ? pairs_to_detect(rates_of(likely.low, std::min(found.more, found.less)), goal)
      : likely.high < figure.margin && equal ? equal
      : either                               ? either
               : pairs_to_detect(rates_of(figure.margin, differing / 2), goal);
  if (!planned || *planned > figure.pairs()) return planned;
  return smaller(pairs_to_detect(found, goal), equal);
}

void decide(FigureComparison& figure, const TestGoal& goal) {
  figure.verdict = verdict_of(figure, goal.alpha);
  if (figure.verdict != Verdict::kCannotTell) return;
  const TestGoal single{.alpha = figure.level, .power = goal.power};
  figure.needed = figure.method == Method::kOrdered ? needed_for_ordered(figure, single)
                                                    : needed_for_mean(figure, single);
  if (figure.needed) figure.needed = std::max(*figure.needed, figure.pairs() + 1);
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
  return settings.metrics.empty() ? parse_figures({}) : settings.metrics;
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

std::vector<FigureComparison> compare_figures(const std::vector<RunPair>& pairs,
                                              const CompareSettings& settings) {
  std::vector<FigureComparison> figures;
  for (const Metric& metric : metrics_of(settings)) {
    FigureComparison figure = figure_of(metric, pairs, settings);
    if (figure.pairs() > 0) figures.push_back(std::move(figure));
  }
  for (const bool of_estimate : {true, false}) adjust(figures, of_estimate, settings.goal.alpha);
  const bool same = compare_hashes(pairs).relation == HashRelation::kSame;
  for (FigureComparison& figure : figures) {
    if (same && figure.metric.of_estimate && never_differs(figure)) {
      figure.p_equivalence = figure.adjusted_p_equivalence = 0;
    }
    decide(figure, settings.goal);
  }
  return figures;
}

Verdict overall(const std::vector<FigureComparison>& figures) {
  const auto any = [&](Verdict verdict) {
    return std::ranges::any_of(figures, [&](const FigureComparison& figure) {
      return figure.metric.of_estimate && figure.verdict == verdict;
    });
  };
  if (any(Verdict::kBetter) && any(Verdict::kWorse)) return Verdict::kMixed;
  if (any(Verdict::kBetter)) return Verdict::kBetter;
  if (any(Verdict::kWorse)) return Verdict::kWorse;
  if (any(Verdict::kCannotTell)) return Verdict::kCannotTell;
  return any(Verdict::kEqual) ? Verdict::kEqual : Verdict::kCannotTell;
}

}  // namespace vinebench::harness
