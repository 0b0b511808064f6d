// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/comparison/comparison_report.h"

#include <fmt/format.h>

#include <cmath>

#include "harness/comparison/repeats.h"
#include "harness/comparison/run_hashes.h"

namespace vinebench::harness {
namespace {

/// An effect, or an end of its interval.
std::string effect_text(const MetricComparison& result, double effect) {
  switch (result.method) {
    case Method::kRatio:
      return fmt::format("{:+.1f} %", 100 * std::expm1(effect));
    case Method::kDifference:
      return fmt::format("{:+.{}f}", effect, result.metric.decimals + 1);
    case Method::kOrdered:
      return fmt::format("{:+.0f} %", 100 * effect);
  }
  return "";
}

std::string interval_text(const MetricComparison& result) {
  if (!result.interval) return "–";
  return effect_text(result, result.interval->low) + " .. " +
         effect_text(result, result.interval->high);
}

std::string change_text(const MetricComparison& result) {
  if (result.method != Method::kOrdered) return effect_text(result, result.effect);
  return fmt::format("{} more, {} less", result.counts.more, result.counts.less);
}

std::string margin_text(const MetricComparison& result) {
  switch (result.method) {
    case Method::kRatio:
      return fmt::format("{:g} %", std::round(1e6 * std::expm1(result.margin)) / 1e4);
    case Method::kDifference:
      return fmt::format("{:g}", result.margin);
    case Method::kOrdered:
      return fmt::format("{:g} % of seeds", 100 * result.margin);
  }
  return "";
}

/// From 100 on to two digits: the spread is not known any better.
std::string rounded_up(std::size_t seeds) {
  std::size_t unit = 1;
  while (seeds >= 100 * unit) unit *= 10;
  return fmt::format("{}{}", unit > 1 ? "about " : "", (seeds + unit - 1) / unit * unit);
}

std::string verdict_text(const MetricComparison& result) {
  std::string text = name_of(result.verdict);
  if (result.verdict != Verdict::kCannotTell) return text;
  if (result.needed) {
    const std::size_t more = *result.needed - result.pairs();
    return text + fmt::format(": {} more seed{}", rounded_up(more), more == 1 ? "" : "s");
  }
  if (result.pairs() < 2) return text + ": at least 1 more seed";
  return text + fmt::format(": more than {} seeds", kMostPairs);
}

std::string comparison_table(const std::vector<MetricComparison>& results, double alpha) {
  std::vector<std::vector<std::string>> rows{{"metric", "pairs", "A", "B", "change",
                                              fmt::format("{:g} % interval", 100 * (1 - alpha)),
                                              "margin", "verdict"}};
  for (const MetricComparison& result : results) {
    rows.push_back({result.metric.title, std::to_string(result.pairs()),
                    format_value(result.metric, result.mean_before),
                    format_value(result.metric, result.mean_after), change_text(result),
                    interval_text(result), margin_text(result), verdict_text(result)});
  }
  return markdown_table(rows, 1);
}

/// Seeds of which at least one repeat does not pass.
struct FailureRate {
  std::size_t failed = 0;
  std::size_t seeds = 0;

  Interval interval(double alpha) const { return clopper_pearson(failed, seeds, alpha); }
};

FailureRate failure_rate(const std::vector<double>& passed) {
  FailureRate rate{.seeds = passed.size()};
  for (const double percent : passed) rate.failed += percent < 100 ? 1 : 0;
  return rate;
}

std::string rate_text(const FailureRate& rate, double alpha) {
  const Interval interval = rate.interval(alpha);
  return fmt::format("{} of {} seeds ({:.1f} .. {:.1f} %)", rate.failed, rate.seeds,
                     100 * interval.low, 100 * interval.high);
}

const MetricComparison* passed_comparison(const std::vector<MetricComparison>& results) {
  for (const MetricComparison& result : results) {
    if (result.metric.key == kPassedKey) return &result;
  }
  return nullptr;
}

std::string failures_text(const std::vector<MetricComparison>& results, double alpha) {
  const MetricComparison* result = passed_comparison(results);
  if (result == nullptr) return "";
  return fmt::format("failing: A {}, B {}; exact test of McNemar p = {:.3g}\n",
                     rate_text(failure_rate(result->before), alpha),
                     rate_text(failure_rate(result->after), alpha), result->p_difference);
}

/// Repeats of one of the sides.
std::vector<RepeatsSummary> repeats_of_side(const std::vector<RunPair>& pairs,
                                            SeedRuns RunPair::*side) {
  std::vector<RepeatedSeed> seeds;
  for (const RunPair& pair : pairs) seeds.push_back({.runs = pair.*side});
  return summarise_repeats(seeds);
}

std::string repeats_text(const PairedRuns& runs) {
  std::string text;
  for (const auto& [name, side] :
       {std::pair("A", &RunPair::before), std::pair("B", &RunPair::after)}) {
    const std::string own = format_repeats(repeats_of_side(runs.pairs, side));
    if (!own.empty()) text += fmt::format("\n{}: {}", name, own);
  }
  return text;
}

std::string heading(const std::string& name, const std::vector<RunPair>& pairs,
                    const std::vector<MetricComparison>& results) {
  const std::string equal = compare_hashes(pairs).relation == HashRelation::kSame
                                ? "; all runs are the same to the byte"
                                : "";
  const Verdict verdict = overall(results);
  const std::string text = verdict == Verdict::kCannotTell ? "cannot tell yet how B differs from A"
                           : verdict == Verdict::kEqual    ? "B is equal to A within the margins"
                                                        : fmt::format("B is {}", name_of(verdict));
  return fmt::format("{}: {} (by the estimate's metrics, {} pair{}{})", name, text, pairs.size(),
                     pairs.size() == 1 ? "" : "s", equal);
}

Json interval_json(const std::optional<Interval>& interval) {
  return interval ? Json({interval->low, interval->high}) : Json();
}

Json metric_json(const MetricComparison& result) {
  Json json{{"metric", result.metric.title},
            {"key", name_of(result.metric)},
            {"method", name_of(result.method)},
            {"pairs", result.pairs()},
            {"a", result.mean_before},
            {"b", result.mean_after},
            {"difference", result.mean_after - result.mean_before},
            {"values_a", result.before},
            {"values_b", result.after},
            {"differences", result.differences},
            {"spread", result.sample.spread},
            {"effect", result.effect},
            {"interval", interval_json(result.interval)},
            {"margin", result.margin},
            {"p_difference", result.p_difference},
            {"p_equivalence", result.p_equivalence},
            {"adjusted_p_difference", result.adjusted_p_difference},
            {"adjusted_p_equivalence", result.adjusted_p_equivalence},
            {"level", result.level},
            {"verdict", name_of(result.verdict)},
            {"pairs_needed", result.needed ? Json(*result.needed) : Json()}};
  if (result.method != Method::kOrdered) return json;
  json["more"] = result.counts.more;
  json["less"] = result.counts.less;
  json["same"] = result.counts.same;
  json["tolerance"] = result.tolerance;
  return json;
}

Json failures_json(const std::vector<MetricComparison>& results, double alpha) {
  const MetricComparison* result = passed_comparison(results);
  if (result == nullptr) return {};
  const auto side = [&](const std::vector<double>& passed) {
    const FailureRate rate = failure_rate(passed);
    return Json{{"failed", rate.failed},
                {"seeds", rate.seeds},
                {"interval", interval_json(rate.interval(alpha))}};
  };
  return {
      {"a", side(result->before)}, {"b", side(result->after)}, {"p_mcnemar", result->p_difference}};
}

}  // namespace

std::string format_comparison(const PairedRuns& runs, const CompareSettings& settings) {
  std::string text;
  for (const auto& [name, pairs] : groups_of(runs)) {
    const std::vector<MetricComparison> results = compare_metrics(pairs, settings);
    text += fmt::format("\n{}\n\n{}{}", heading(name, pairs, results),
                        comparison_table(results, settings.goal.alpha),
                        failures_text(results, settings.goal.alpha));
  }
  text += repeats_text(runs);
  if (const HashComparison hashes = compare_hashes(runs.pairs); !hashes.reason.empty()) {
    text += fmt::format("hashes of A and B are not comparable: {}\n", hashes.reason);
  }
  for (const std::string& run : runs.unpaired) text += fmt::format("not compared: {}\n", run);
  for (const std::string& run : runs.differing) {
    text += fmt::format("warning: not the same experiment: {}\n", run);
  }
  return text;
}

Json comparison_json(const PairedRuns& runs, const CompareSettings& settings) {
  Json groups = Json::array();
  for (const auto& [name, pairs] : groups_of(runs)) {
    const std::vector<MetricComparison> results = compare_metrics(pairs, settings);
    Json list = Json::array();
    for (const MetricComparison& result : results) list.push_back(metric_json(result));
    Json seeds = Json::array();
    for (const RunPair& pair : pairs) {
      seeds.push_back({{"scenario", pair.before.scenario},
                       {"seed", pair.before.seed},
                       {"repeats", pair.before.repeats.size()}});
    }
    groups.push_back({{"name", name},
                      {"verdict", name_of(overall(results))},
                      {"identical", compare_hashes(pairs).relation == HashRelation::kSame},
                      {"pairs", seeds},
                      {"metrics", list},
                      {"failures", failures_json(results, settings.goal.alpha)}});
  }
  return {{"alpha", settings.goal.alpha},
          {"power", settings.goal.power},
          {"groups", groups},
          {"repeats",
           {{"a", repeats_json(repeats_of_side(runs.pairs, &RunPair::before))},
            {"b", repeats_json(repeats_of_side(runs.pairs, &RunPair::after))}}},
          {"hashes_not_comparable", compare_hashes(runs.pairs).reason},
          {"not_compared", runs.unpaired},
          {"differing", runs.differing}};
}

}  // namespace vinebench::harness
