// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/statistics/shares.h"

#include <algorithm>

#include "harness/statistics/distributions.h"

namespace vinebench::harness {

Interval clopper_pearson(std::size_t events, std::size_t trials, double alpha) {
  const auto k = static_cast<double>(events);
  const auto n = static_cast<double>(trials);
  return {events == 0 ? 0 : beta_quantile(alpha / 2, k, n - k + 1),
          events == trials ? 1 : beta_quantile(1 - alpha / 2, k + 1, n - k)};
}

double p_of_share_or_more(std::size_t events, std::size_t trials, double share) {
  return trials == 0 ? 1 : binomial_cdf(events, trials, share);
}

double PairedCounts::net_share() const {
  if (pairs() == 0) return 0;
  return (static_cast<double>(more) - static_cast<double>(less)) / static_cast<double>(pairs());
}

double p_of_no_difference(const PairedCounts& counts) {
  const std::size_t differing = counts.more + counts.less;
  if (differing == 0) return 1;
  return std::min(1.0, 2 * binomial_cdf(std::min(counts.more, counts.less), differing, 0.5));
}

double p_of_no_equivalence(const PairedCounts& counts, double margin) {
  return p_of_share_or_more(std::max(counts.more, counts.less), counts.pairs(), margin);
}

Interval interval_of(const PairedCounts& counts, double alpha) {
  const Interval more = clopper_pearson(counts.more, counts.pairs(), alpha / 2);
  const Interval less = clopper_pearson(counts.less, counts.pairs(), alpha / 2);
  return {more.low - less.high, more.high - less.low};
}

}  // namespace vinebench::harness
