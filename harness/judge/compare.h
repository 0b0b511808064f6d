// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/judge/metric_table.h"

namespace vinebench::harness {

/// Two runs of one scenario and seed.
struct RunPair {
  std::string scenario;
  std::int64_t seed = 0;
  Json before;  ///< metrics.json
  Json after;
};

/// Runs of two folders, paired by scenario and seed, in their order.
struct PairedRuns {
  std::vector<RunPair> pairs;
  std::vector<std::string> unpaired;  ///< runs that are in one of the folders only, for people
};

/// Each folder is a run's or has runs' folders in it, however deep. Throws Error where there is no
/// run, one twice, a metrics.json that cannot be read, and where nothing pairs.
PairedRuns pair_runs(const std::filesystem::path& before, const std::filesystem::path& after);

enum class Change { kBetter, kSame, kWorse, kMixed, kUnknown };
const char* name_of(Change change);

/// A figure over the pairs that have it on both sides, in its shown unit.
struct MetricChange {
  Metric figure{};
  std::size_t pairs = 0;
  double before = 0;                   ///< mean
  double after = 0;                    ///< mean
  std::vector<double> differences{};   ///< after - before, pair by pair
  std::optional<double> half_width{};  ///< of the 95 % confidence interval of the mean difference
  Change change = Change::kUnknown;

  double difference() const { return after - before; }
};

/// Better or worse where the interval of the mean difference (Student's t, n - 1 degrees of
/// freedom) leaves out zero, same where it does not. One pair has no interval: unknown, unless both
/// are equal. Figures that no pair has are left out.
std::vector<MetricChange> compare_metrics(const std::vector<RunPair>& pairs);

/// Of the figures that say how good the estimate is: better or worse when some are and none is the
/// other way; unknown when that is all there is.
Change overall(const std::vector<MetricChange>& changes);

/// For people: each scenario by itself, and all together where there are several.
std::string format_comparison(const PairedRuns& runs);

/// The same as data, with the differences of every pair.
Json comparison_json(const PairedRuns& runs);

/// The factor by which Student's t has 95 % of its probability within ± so many standard errors.
/// Exact to 1e-3 up to 30 degrees of freedom (tabulated), to 1e-4 beyond (Abramowitz and Stegun
/// 26.7.5). Needs one degree at least.
double student_t_95(std::size_t degrees_of_freedom);

}  // namespace vinebench::harness
