// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace vinebench::harness {

/// Two-sided: both ends belong to it.
struct Interval {
  double low = 0;
  double high = 0;
};

/// Differences of pairs, summarised. Inference is by Student's t with pairs - 1 degrees of freedom:
/// exact for normally distributed differences.
struct PairedMean {
  std::size_t pairs = 0;
  double mean = 0;
  double spread = 0;  ///< standard deviation of the differences; 0 for a single pair

  /// The differences tell of their own spread: at least two pairs, nothing infinite.
  bool has_spread() const;
};

PairedMean paired_mean(const std::vector<double>& differences);

/// Of the mean, which it contains with probability 1 - alpha. Requires has_spread().
Interval interval_of(const PairedMean& sample, double alpha);

/// Two-sided p-value of the hypothesis that the mean is zero; 1 without a spread.
double p_of_no_difference(const PairedMean& sample);

/// p-value of the hypothesis that the mean is `margin` or more away from zero, by two one-sided
/// tests (Schuirmann 1987, J. Pharmacokinet. Biopharm. 15:657): the larger of both. At most alpha
/// if and only if the interval of 2 alpha lies inside of the margins. 1 without a spread.
double p_of_no_equivalence(const PairedMean& sample, double margin);

}  // namespace vinebench::harness
