// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

namespace vinebench::harness {

// How many pairs a question needs. Each function of that name gives the smallest number whose power
// is at least that of the goal; empty beyond kMostPairs.

inline constexpr std::size_t kMostPairs = 100'000;

/// What a test has to reach.
struct TestGoal {
  double alpha = 0.05;  ///< probability of a false claim, at most
  double power = 0.80;  ///< probability of a true one, at least
};

/// Probability that the two-sided paired t test rejects "no difference", where the mean is `effect`
/// standard deviations of the differences from zero. Exact (noncentral t).
double power_to_detect(std::size_t pairs, double effect, double alpha);

/// Probability that the two one-sided t tests show a mean within `margin`, where it is `effect`;
/// both in standard deviations of the differences. By noncentral t, an approximation that is
/// slightly low below a power of a half (Phillips 1990, J. Pharmacokinet. Biopharm. 18:137, has
/// the exact integral).
double power_to_show_equal(std::size_t pairs, double margin, double effect, double alpha);

std::optional<std::size_t> pairs_to_detect(double effect, const TestGoal& goal);
/// Empty unless the effect is within the margin.
std::optional<std::size_t> pairs_to_show_equal(double margin, double effect, const TestGoal& goal);

/// What happens in pairs that pass or fail, or have more or less: probabilities.
struct PairRates {
  double more = 0;
  double less = 0;
};

/// Probability that the sign test (McNemar's) rejects "as likely". Exact but for terms of less than
/// 1e-9 in total.
double power_to_detect(std::size_t pairs, const PairRates& rates, double alpha);

/// Probability, or a lower bound of it (Bonferroni), that both rates are shown to be below the
/// margin.
double power_to_show_equal(std::size_t pairs, const PairRates& rates, double margin, double alpha);

std::optional<std::size_t> pairs_to_detect(const PairRates& rates, const TestGoal& goal);
/// Empty unless both rates are below the margin.
std::optional<std::size_t> pairs_to_show_equal(const PairRates& rates, double margin,
                                               const TestGoal& goal);

}  // namespace vinebench::harness
