// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "harness/comparison/paired_runs.h"
#include "harness/statistics/paired_mean.h"
#include "harness/statistics/variance_components.h"

namespace vinebench::harness {

/// Repeats of one seed of which some fail.
struct FailingSeed {
  std::int64_t seed = 0;
  std::size_t failed = 0;
  std::size_t repeats = 0;
  Interval rate{};                    ///< of failure, Clopper-Pearson, 95 %
  std::vector<std::string> checks{};  ///< expectations that some repeats do not meet, by name
  /// All repeats fail, not only some.
  bool broken() const { return failed == repeats; }
};

/// A metric's variance between repeats, that of the system, apart from that between seeds, that of
/// the worlds.
struct MetricVariance {
  Metric metric{};
  bool logarithmic = false;  ///< of the logarithm: standard deviations are shares of the value
  VarianceComponents components{};
};

/// A scenario whose seeds ran several times.
struct RepeatsSummary {
  std::string scenario{};
  std::size_t seeds = 0;  ///< with several repeats
  std::size_t runs = 0;
  std::vector<FailingSeed> failing{};     ///< flaky ones and broken ones
  std::vector<std::int64_t> differing{};  ///< seeds whose repeats have different hashes
  bool hashed = false;                    ///< every run has a hash
  std::string not_comparable{};           ///< why hashes of some seed's repeats are not; or empty
  std::vector<MetricVariance> variances{};

  bool deterministic() const { return hashed && differing.empty() && not_comparable.empty(); }
};

/// A seed's repeats that have no results count as failed.
struct RepeatedSeed {
  SeedRuns runs{};
  std::size_t without_results = 0;
};

/// By scenario; those without repeats are left out.
std::vector<RepeatsSummary> summarise_repeats(const std::vector<RepeatedSeed>& seeds);

/// Human-readable, a paragraph for each scenario; empty if there is none.
std::string format_repeats(const std::vector<RepeatsSummary>& summaries);

Json repeats_json(const std::vector<RepeatsSummary>& summaries);

}  // namespace vinebench::harness
