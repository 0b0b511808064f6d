// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/report/metric_table.h"

namespace vinebench::harness {

/// Two runs of one scenario and seed.
struct RunPair {
  StoredRun before;
  StoredRun after;
};

/// Runs of two folders, paired by scenario and seed, in their order.
struct PairedRuns {
  std::vector<RunPair> pairs;
  /// Runs that are in only one of the folders, or of another length, human-readable.
  std::vector<std::string> unpaired;
  /// Pairs whose experiments differ beside the SLAM system's settings, human-readable.
  std::vector<std::string> differing;
};

/// Each folder is a run's folder or contains runs' folders at any depth. Runs of different numbers
/// of frames are no pair. Throws Error if there is no run, a duplicate run, an unreadable
/// metrics.json or scenario.resolved.yaml, or no pair.
PairedRuns pair_runs(const std::filesystem::path& before, const std::filesystem::path& after);

enum class Change { kBetter, kSame, kWorse, kMixed, kUnknown };
const char* name_of(Change change);

/// A metric over the pairs that have it on both sides, in its displayed unit.
struct MetricChange {
  Metric metric{};
  std::size_t pairs = 0;
  double before = 0;                   ///< mean
  double after = 0;                    ///< mean
  std::vector<double> differences{};   ///< after - before, pair by pair
  std::optional<double> half_width{};  ///< of the 95 % confidence interval of the mean difference
  Change change = Change::kUnknown;

  double difference() const { return after - before; }
};

/// Better or worse if the interval of the mean difference (Student's t, n - 1 degrees of freedom)
/// excludes zero, same otherwise. One pair has no interval: unknown, unless both are equal. Metrics
/// that no pair has are left out.
std::vector<MetricChange> compare_metrics(const std::vector<RunPair>& pairs);

/// Over the metrics of the estimate: better or worse if some are and none is the opposite; unknown
/// if all are unknown.
Change overall(const std::vector<MetricChange>& changes);

/// Human-readable: each scenario separately, and all together if there are several.
std::string format_comparison(const PairedRuns& runs);

/// The same as data, with the differences of every pair.
Json comparison_json(const PairedRuns& runs);

/// The two-sided 95 % quantile of Student's t distribution. Exact to 1e-3 up to 30 degrees of
/// freedom (tabulated), to 1e-4 beyond (Abramowitz and Stegun 26.7.5). Requires at least one
/// degree.
double student_t_95(std::size_t degrees_of_freedom);

}  // namespace vinebench::harness
