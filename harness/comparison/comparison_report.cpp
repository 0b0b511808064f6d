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
std::string effect_text(const FigureComparison& figure, double effect) {
  switch (figure.method) {
    case Method::kRatio:
      return fmt::format("{:+.1f} %", 100 * std::expm1(effect));
    case Method::kDifference:
      return fmt::format("{:+.{}f}", effect, figure.metric.decimals + 1);
    case Method::kOrdered:
      return fmt::format("{:+.0f} %", 100 * effect);
  }
  return "";
}

std::string interval_text(const FigureComparison& figure) {
  if (!figure.interval) return "–";
  return effect_text(figure, figure.interval->low) + " .. " +
         effect_text(figure, figure.interval->high);
}

std::string change_text(const FigureComparison& figure) {
  if (figure.method != Method::kOrdered) return effect_text(figure, figure.effect);
  return fmt::format("{} more, {} less", figure.counts.more, figure.counts.less);
}

std::string margin_text(const FigureComparison& figure) {
  switch (figure.method) {
    case Method::kRatio:
      return fmt::format("{:g} %", std::round(1e6 * std::expm1(figure.margin)) / 1e4);
    case Method::kDifference:
      return fmt::format("{:g}", figure.margin);
    case Method::kOrdered:
      return fmt::format("{:g} % of seeds", 100 * figure.margin);
  }
  return "";
}

std::string verdict_text(const FigureComparison& figure) {
  std::string text = name_of(figure.verdict);
  if (figure.verdict != Verdict::kCannotTell) return text;
  if (figure.needed) {
    const std::size_t more = *figure.needed - figure.pairs();
    return text + fmt::format(": {} more seed{}", more, more == 1 ? "" : "s");
  }
  if (figure.pairs() < 2) return text + ": at least 1 more seed";
  return text + fmt::format(": more than {} seeds", kMostPairs);
}

std::string comparison_table(const std::vector<FigureComparison>& figures, double alpha) {
  std::vector<std::vector<std::string>> rows{{"figure", "pairs", "A", "B", "change",
                                              fmt::format("{:g} % interval", 100 * (1 - alpha)),
                                              "margin", "verdict"}};
  for (const FigureComparison& figure : figures) {
    rows.push_back({figure.metric.title, std::to_string(figure.pairs()),
                    format_value(figure.metric, figure.mean_before),
                    format_value(figure.metric, figure.mean_after), change_text(figure),
                    interval_text(figure), margin_text(figure), verdict_text(figure)});
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

const FigureComparison* passed_figure(const std::vector<FigureComparison>& figures) {
  for (const FigureComparison& figure : figures) {
    if (figure.metric.key == kPassedKey) return &figure;
  }
  return nullptr;
}

std::string failures_text(const std::vector<FigureComparison>& figures, double alpha) {
  const FigureComparison* figure = passed_figure(figures);
  if (figure == nullptr) return "";
  return fmt::format("failing: A {}, B {}; exact test of McNemar p = {:.3g}\n",
                     rate_text(failure_rate(figure->before), alpha),
                     rate_text(failure_rate(figure->after), alpha), figure->p_difference);
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
                    const std::vector<FigureComparison>& figures) {
  const std::string equal = compare_hashes(pairs).relation == HashRelation::kSame
                                ? "; all runs are the same to the byte"
                                : "";
  const Verdict verdict = overall(figures);
  const std::string text = verdict == Verdict::kCannotTell ? "cannot tell yet how B differs from A"
                           : verdict == Verdict::kEqual    ? "B is equal to A within the margins"
                                                        : fmt::format("B is {}", name_of(verdict));
  return fmt::format("{}: {} (by the estimate's figures, {} pair{}{})", name, text, pairs.size(),
                     pairs.size() == 1 ? "" : "s", equal);
}

Json interval_json(const std::optional<Interval>& interval) {
  return interval ? Json({interval->low, interval->high}) : Json();
}

Json figure_json(const FigureComparison& figure) {
  Json json{{"figure", figure.metric.title},
            {"key", name_of(figure.metric)},
            {"method", name_of(figure.method)},
            {"pairs", figure.pairs()},
            {"a", figure.mean_before},
            {"b", figure.mean_after},
            {"difference", figure.mean_after - figure.mean_before},
            {"values_a", figure.before},
            {"values_b", figure.after},
            {"differences", figure.differences},
            {"spread", figure.sample.spread},
            {"effect", figure.effect},
            {"interval", interval_json(figure.interval)},
            {"margin", figure.margin},
            {"p_difference", figure.p_difference},
            {"p_equivalence", figure.p_equivalence},
            {"adjusted_p_difference", figure.adjusted_p_difference},
            {"adjusted_p_equivalence", figure.adjusted_p_equivalence},
            {"level", figure.level},
            {"verdict", name_of(figure.verdict)},
            {"pairs_needed", figure.needed ? Json(*figure.needed) : Json()}};
  if (figure.method != Method::kOrdered) return json;
  json["more"] = figure.counts.more;
  json["less"] = figure.counts.less;
  json["same"] = figure.counts.same;
  json["tolerance"] = figure.tolerance;
  return json;
}

Json failures_json(const std::vector<FigureComparison>& figures, double alpha) {
  const FigureComparison* figure = passed_figure(figures);
  if (figure == nullptr) return {};
  const auto side = [&](const std::vector<double>& passed) {
    const FailureRate rate = failure_rate(passed);
    return Json{{"failed", rate.failed},
                {"seeds", rate.seeds},
                {"interval", interval_json(rate.interval(alpha))}};
  };
  return {
      {"a", side(figure->before)}, {"b", side(figure->after)}, {"p_mcnemar", figure->p_difference}};
}

}  // namespace

std::string format_comparison(const PairedRuns& runs, const CompareSettings& settings) {
  std::string text;
  for (const auto& [name, pairs] : groups_of(runs)) {
    const std::vector<FigureComparison> figures = compare_figures(pairs, settings);
    text += fmt::format("\n{}\n\n{}{}", heading(name, pairs, figures),
                        comparison_table(figures, settings.goal.alpha),
                        failures_text(figures, settings.goal.alpha));
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
    const std::vector<FigureComparison> figures = compare_figures(pairs, settings);
    Json list = Json::array();
    for (const FigureComparison& figure : figures) list.push_back(figure_json(figure));
    Json seeds = Json::array();
    for (const RunPair& pair : pairs) {
      seeds.push_back({{"scenario", pair.before.scenario},
                       {"seed", pair.before.seed},
                       {"repeats", pair.before.repeats.size()}});
    }
    groups.push_back({{"name", name},
                      {"verdict", name_of(overall(figures))},
                      {"identical", compare_hashes(pairs).relation == HashRelation::kSame},
                      {"pairs", seeds},
                      {"figures", list},
                      {"failures", failures_json(figures, settings.goal.alpha)}});
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
