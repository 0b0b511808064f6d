// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "harness/statistics/paired_mean.h"

namespace vinebench::harness {

/// Interval of a probability by `events` in `trials` (Clopper and Pearson 1934, Biometrika
/// 26:404): contains it with probability 1 - alpha or more, however rare the events are. Requires
/// a trial.
Interval clopper_pearson(std::size_t events, std::size_t trials, double alpha);

/// p-value of the hypothesis that an event's probability is `share` or more; exact.
double p_of_share_or_more(std::size_t events, std::size_t trials, double share);

/// Pairs in which the second has more than the first, less, or the same.
struct PairedCounts {
  std::size_t more = 0;
  std::size_t less = 0;
  std::size_t same = 0;

  std::size_t pairs() const { return more + less + same; }
  /// Share of the pairs with more, less the share of those with less: -1 to 1. 0 without pairs.
  double net_share() const;
};

/// Two-sided p-value of the hypothesis that more and less are as likely: the exact test of McNemar
/// (1947, Psychometrika 12:153) if pairs pass or fail, the sign test otherwise. Pairs of the same
/// do not take part. 1 if all are the same.
double p_of_no_difference(const PairedCounts& counts);

/// p-value of the hypothesis that more or less happens in `margin` (a share) of the pairs or more:
/// the larger of two exact one-sided tests.
double p_of_no_equivalence(const PairedCounts& counts, double margin);

/// Interval of the net share, from the Clopper-Pearson intervals of both parts at alpha / 2 each
/// (Bonferroni): contains it with probability 1 - alpha or more. Requires a pair.
Interval interval_of(const PairedCounts& counts, double alpha);

}  // namespace vinebench::harness
