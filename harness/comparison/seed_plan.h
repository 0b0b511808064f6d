// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/comparison/compare.h"

namespace vinebench::harness {

/// How many seeds a metric needs, each with a run of both systems.
struct MetricPlan {
  Metric metric{};
  Method method = Method::kRatio;
  std::size_t seeds = 0;  ///< measured
  double spread = 0;      ///< standard deviation of a pair's difference (log ratio, displayed unit)
  double rate = 0;        ///< kOrdered: share of pairs that have more by chance, likewise less
  double effect = 0;      ///< to detect: log ratio, displayed unit, net share of the pairs
  double level = 0;       ///< of single tests: alpha / metrics
  std::optional<std::size_t> to_detect{};      ///< empty above kMostPairs
  std::optional<std::size_t> to_show_equal{};  ///< likewise; or if chance alone is above the effect
};

/// By the spread of the pairs' differences; of ordered metrics, as if those that differ did so by
/// chance, as many in either direction.
/// `settings.margins` has the effects to detect. Throws Error if no metric was measured for two
/// seeds of a scenario.
std::vector<MetricPlan> plan_seeds(const std::vector<RunPair>& pairs,
                                   const CompareSettings& settings);

/// By the spread of one system between the seeds of each scenario, as if another system's results
/// had nothing in common with it: the variance of a difference is twice that of a value. Pairs of
/// the same worlds usually need fewer.
std::vector<MetricPlan> plan_seeds(const std::vector<SeedRuns>& runs,
                                   const CompareSettings& settings);

std::string format_plan(const std::vector<MetricPlan>& plans, const CompareSettings& settings);

Json plan_json(const std::vector<MetricPlan>& plans, const CompareSettings& settings);

}  // namespace vinebench::harness
