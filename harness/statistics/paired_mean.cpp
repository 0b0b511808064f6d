// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/statistics/paired_mean.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "harness/statistics/distributions.h"

namespace vinebench::harness {
namespace {

double standard_error(const PairedMean& sample) {
  return sample.spread / std::sqrt(static_cast<double>(sample.pairs));
}

double degrees_of(const PairedMean& sample) {
  return static_cast<double>(sample.pairs - 1);
}

/// p-value of the hypothesis that the mean is at least `value`. Without any spread the mean is
/// known.
double p_of_at_least(const PairedMean& sample, double value) {
  const double distance = sample.mean - value;
  if (sample.spread == 0) return distance < 0 ? 0 : 1;
  return student_t_cdf(distance / standard_error(sample), degrees_of(sample));
}

}  // namespace

bool PairedMean::has_spread() const {
  return pairs > 1 && std::isfinite(mean) && std::isfinite(spread);
}

PairedMean paired_mean(const std::vector<double>& differences) {
  PairedMean sample{.pairs = differences.size()};
  if (differences.empty()) return sample;
  const double n = static_cast<double>(differences.size());
  sample.mean = std::accumulate(differences.begin(), differences.end(), 0.0) / n;
  if (differences.size() < 2) return sample;
  // Rounding gives equal differences a spread.
  if (std::ranges::adjacent_find(differences, std::not_equal_to<>()) == differences.end()) {
    sample.mean = differences.front();
    return sample;
  }
  double squares = 0;
  for (const double d : differences) squares += (d - sample.mean) * (d - sample.mean);
  sample.spread = std::sqrt(squares / (n - 1));
  return sample;
}

Interval interval_of(const PairedMean& sample, double alpha) {
  const double t = student_t_quantile(1 - alpha / 2, degrees_of(sample));
  const double half = t * standard_error(sample);
  return {sample.mean - half, sample.mean + half};
}

double p_of_no_difference(const PairedMean& sample) {
  if (!sample.has_spread() || sample.mean == 0) return 1;
  if (sample.spread == 0) return 0;
  const double t = std::abs(sample.mean) / standard_error(sample);
  return 2 * student_t_cdf(-t, degrees_of(sample));
}

double p_of_no_equivalence(const PairedMean& sample, double margin) {
  if (!sample.has_spread()) return 1;
  PairedMean mirrored = sample;
  mirrored.mean = -sample.mean;
  return std::max(p_of_at_least(sample, margin), p_of_at_least(mirrored, margin));
}

}  // namespace vinebench::harness
