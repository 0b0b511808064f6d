// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace vinebench::harness {

/// Variance between groups (worlds) apart from that within them (repeats of one world), by one-way
/// analysis of variance with random effects: moments, also for groups of different sizes (Searle,
/// Casella, McCulloch 1992, Variance Components, 3.6).
struct VarianceComponents {
  std::size_t groups = 0;
  std::size_t values = 0;
  double within = 0;   ///< variance of repeats
  double between = 0;  ///< variance of groups, 0 where the estimate is negative
  double mean_square_within = 0;
  double mean_square_between = 0;
  std::optional<double> f{};  ///< ratio of the mean squares; empty if all repeats agree
  /// p-value of the hypothesis that groups do not differ; empty with f.
  std::optional<double> p{};

  /// Share of the variance of a single value that repeats have; 0 if nothing varies.
  double share_within() const;
};

/// Empty unless there are two groups, and one with two values.
std::optional<VarianceComponents> variance_components(
    const std::vector<std::vector<double>>& groups);

}  // namespace vinebench::harness
