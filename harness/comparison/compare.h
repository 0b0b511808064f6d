// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/comparison/margins.h"
#include "harness/comparison/paired_runs.h"
#include "harness/statistics/power.h"
#include "harness/statistics/shares.h"

namespace vinebench::harness {

/// B is better, worse, or equal to A within the margin, or the runs are too few to tell; mixed only
/// over several metrics.
enum class Verdict { kBetter, kWorse, kEqual, kCannotTell, kMixed };
const char* name_of(Verdict verdict);

/// What a metric's pairs are compared by.
enum class Method {
  kRatio,       ///< Student's t on log(B / A)
  kDifference,  ///< Student's t on B - A
  kOrdered,     ///< exact binomial tests of whether B has more, less or the same
};
const char* name_of(Method method);

struct CompareSettings {
  Margins margins{};
  TestGoal goal{};  ///< alpha for all metrics of a table together; power for "N more seeds"
  std::vector<Metric> metrics{};  ///< those that comparisons show if empty
};

std::vector<Metric> metrics_of(const CompareSettings& settings);

/// A metric over the pairs that have it on both sides.
struct MetricComparison {
  Metric metric{};
  Method method = Method::kRatio;
  std::vector<double> before{};  ///< pair by pair, mean of the repeats, displayed unit
  std::vector<double> after{};
  double mean_before = 0;  ///< geometric for kRatio
  double mean_after = 0;
  std::vector<double> differences{};   ///< log(B / A) or B - A
  PairedMean sample{};                 ///< of the differences
  PairedCounts counts{};               ///< kOrdered: B has more, less or the same
  double effect = 0;                   ///< mean difference; kOrdered: net share of the pairs
  std::optional<Interval> interval{};  ///< of the effect, 1 - alpha, for this metric alone
  double margin = 0;     ///< of the effect: log ratio, displayed unit, share of the pairs
  double tolerance = 0;  ///< kOrdered: displayed unit, what counts as the same
  double p_difference = 1;
  double p_equivalence = 1;
  double adjusted_p_difference = 1;  ///< Holm, over the table's metrics
  double adjusted_p_equivalence = 1;
  double level = 0;  ///< of single tests, on which `needed` is based: alpha / metrics
  Verdict verdict = Verdict::kCannotTell;
  /// Pairs in total that would tell, if it cannot be told; empty if unknown or above kMostPairs.
  std::optional<std::size_t> needed{};

  std::size_t pairs() const { return differences.size(); }
};

/// Metrics that no pair has are left out. Estimate and cost (run times) are two families for Holm's
/// correction.
std::vector<MetricComparison> compare_metrics(const std::vector<RunPair>& pairs,
                                              const CompareSettings& settings);

/// Over the metrics of the estimate: equal if all are; better or worse if some are and none is the
/// opposite, mixed if both; else it cannot be told.
Verdict overall(const std::vector<MetricComparison>& results);

}  // namespace vinebench::harness
