// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/statistics/power.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "harness/statistics/distributions.h"

namespace vinebench::harness {
namespace {

/// Larger effects are as certain.
constexpr double kLargestEffect = 1e6;

/// The first number from `first` on whose power suffices, for powers that grow with it. Exact
/// tests' powers are saw-toothed; then one of the first, no later one is needed.
std::optional<std::size_t> smallest(std::size_t first, double wanted,
                                    const std::function<double(std::size_t)>& power) {
  std::size_t enough = first;
  while (power(enough) < wanted) {
    if (enough >= kMostPairs) return std::nullopt;
    enough = std::min(2 * enough, kMostPairs);
  }
  std::size_t low = enough == first ? first : enough / 2;
  while (low < enough) {
    const std::size_t middle = low + (enough - low) / 2;
    if (power(middle) >= wanted) {
      enough = middle;
    } else {
      low = middle + 1;
    }
  }
  return enough;
}

/// The number of events around the mean of a binomial distribution that matter.
std::pair<std::size_t, std::size_t> bulk_of(std::size_t trials, double probability) {
  const double mean = static_cast<double>(trials) * probability;
  const double reach = 7 * std::sqrt(mean * (1 - probability)) + 10;
  const double high = std::min(static_cast<double>(trials), mean + reach);
  return {static_cast<std::size_t>(std::max(0.0, mean - reach)), static_cast<std::size_t>(high)};
}

/// The largest number of events that the one-sided test rejects; empty if it rejects none.
std::optional<std::size_t> critical_events(std::size_t trials, double probability, double level) {
  std::size_t low = 0;
  std::size_t high = trials;
  if (binomial_cdf(0, trials, probability) > level) return std::nullopt;
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    (binomial_cdf(middle, trials, probability) <= level ? low : high) = middle;
  }
  return low;
}

}  // namespace

double power_to_detect(std::size_t pairs, double effect, double alpha) {
  if (pairs < 2) return 0;
  const double degrees = static_cast<double>(pairs - 1);
  const double shift =
      std::min(std::abs(effect), kLargestEffect) * std::sqrt(static_cast<double>(pairs));
  const double t = student_t_quantile(1 - alpha / 2, degrees);
  return 1 - noncentral_t_cdf(t, degrees, shift) + noncentral_t_cdf(-t, degrees, shift);
}

double power_to_show_equal(std::size_t pairs, double margin, double effect, double alpha) {
  if (pairs < 2) return 0;
  const double degrees = static_cast<double>(pairs - 1);
  const double root = std::sqrt(static_cast<double>(pairs));
  const double t = student_t_quantile(1 - alpha, degrees);
  effect = std::clamp(effect, -kLargestEffect, kLargestEffect);
  margin = std::min(margin, 2 * kLargestEffect);
  return std::max(0.0, noncentral_t_cdf(-t, degrees, (effect - margin) * root) -
                           noncentral_t_cdf(t, degrees, (effect + margin) * root));
}

std::optional<std::size_t> pairs_to_detect(double effect, const TestGoal& goal) {
  if (effect == 0) return std::nullopt;
  return smallest(2, goal.power,
                  [&](std::size_t n) { return power_to_detect(n, effect, goal.alpha); });
}

std::optional<std::size_t> pairs_to_show_equal(double margin, double effect, const TestGoal& goal) {
  if (std::abs(effect) >= margin) return std::nullopt;
  return smallest(2, goal.power, [&](std::size_t n) {
    return power_to_show_equal(n, margin, effect, goal.alpha);
  });
}

double power_to_detect(std::size_t pairs, const PairRates& rates, double alpha) {
  const double differing = std::min(1.0, rates.more + rates.less);
  if (differing <= 0) return 0;
  const double more = rates.more / (rates.more + rates.less);
  const auto [first, last] = bulk_of(pairs, differing);
  double power = 0;
  std::optional<std::size_t> critical;
  for (std::size_t d = std::max<std::size_t>(first, 1); d <= last; ++d) {
    // One pair more allows one event more, at most.
    if (!critical) {
      critical = critical_events(d, 0.5, alpha / 2);
    } else if (binomial_cdf(*critical + 1, d, 0.5) <= alpha / 2) {
      ++*critical;
    }
    if (!critical) continue;
    const double rejected = binomial_cdf(*critical, d, more) + binomial_cdf(*critical, d, 1 - more);
    power += binomial_probability(d, pairs, differing) * rejected;
  }
  return power;
}

double power_to_show_equal(std::size_t pairs, const PairRates& rates, double margin, double alpha) {
  const auto critical = critical_events(pairs, margin, alpha);
  if (!critical) return 0;
  return std::max(0.0, binomial_cdf(*critical, pairs, rates.more) +
                           binomial_cdf(*critical, pairs, rates.less) - 1);
}

std::optional<std::size_t> pairs_to_detect(const PairRates& rates, const TestGoal& goal) {
  if (rates.more == rates.less) return std::nullopt;
  return smallest(1, goal.power,
                  [&](std::size_t n) { return power_to_detect(n, rates, goal.alpha); });
}

std::optional<std::size_t> pairs_to_show_equal(const PairRates& rates, double margin,
                                               const TestGoal& goal) {
  if (std::max(rates.more, rates.less) >= margin) return std::nullopt;
  return smallest(1, goal.power,
                  [&](std::size_t n) { return power_to_show_equal(n, rates, margin, goal.alpha); });
}

}  // namespace vinebench::harness
