// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/statistics/variance_components.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "harness/statistics/distributions.h"
#include "harness/statistics/paired_mean.h"

namespace vinebench::harness {
namespace {

struct SumsOfSquares {
  double within = 0;
  double between = 0;
  double squared_sizes = 0;
};

SumsOfSquares sums_of_squares(const std::vector<std::vector<double>>& groups, double mean) {
  SumsOfSquares sums;
  for (const std::vector<double>& group : groups) {
    if (group.empty()) continue;
    const PairedMean own = paired_mean(group);
    const auto size = static_cast<double>(group.size());
    sums.within += own.spread * own.spread * (size - 1);
    sums.between += size * (own.mean - mean) * (own.mean - mean);
    sums.squared_sizes += size * size;
  }
  return sums;
}

}  // namespace

double VarianceComponents::share_within() const {
  return within + between > 0 ? within / (within + between) : 0;
}

std::optional<VarianceComponents> variance_components(
    const std::vector<std::vector<double>>& groups) {
  VarianceComponents found;
  double sum = 0;
  for (const std::vector<double>& group : groups) {
    found.groups += group.empty() ? 0 : 1;
    found.values += group.size();
    sum = std::accumulate(group.begin(), group.end(), sum);
  }
  if (found.groups < 2 || found.values == found.groups) return std::nullopt;
  const auto k = static_cast<double>(found.groups);
  const auto n = static_cast<double>(found.values);
  const SumsOfSquares sums = sums_of_squares(groups, sum / n);
  if (!std::isfinite(sums.within) || !std::isfinite(sums.between)) return std::nullopt;
  found.mean_square_between = sums.between / (k - 1);
  found.mean_square_within = sums.within / (n - k);
  found.within = found.mean_square_within;
  const double size = (n - sums.squared_sizes / n) / (k - 1);  // mean, for unequal groups
  found.between = std::max(0.0, (found.mean_square_between - found.mean_square_within) / size);
  if (found.mean_square_within > 0) {
    found.f = found.mean_square_between / found.mean_square_within;
    found.p = f_survival(*found.f, k - 1, n - k);
  }
  return found;
}

}  // namespace vinebench::harness
