// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/search/excess.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/util/error.h"
#include "core/util/suggestion.h"
#include "harness/judge/bounds.h"

namespace vinebench::harness {
namespace {

constexpr double kUnmeasured = 4;  // sixteen times what is allowed
constexpr double kLeast = 1e-9;    // m, degrees or a share, so that a logarithm exists

double excess_over(const Bound& bound, double measured, double allowed) {
  const bool holds = bound.at_least ? measured >= allowed : measured <= allowed;
  const double ratio = bound.at_least ? std::max(allowed, kLeast) / std::max(measured, kLeast)
                                      : std::max(measured, kLeast) / std::max(allowed, kLeast);
  const bool gradual = bound.spread == Spread::kError || bound.spread == Spread::kRatio;
  if (holds) return gradual ? std::max(std::log2(ratio), -kUnmeasured) : -1;
  return std::clamp(std::log2(ratio), kLeast, kUnmeasured);
}

}  // namespace

double excess_of(const StoredRun& run, const Expectations& expectations, const Expectations& goal,
                 const std::string& only) {
  double excess = -kUnmeasured;
  for (const Bound& bound : bounds()) {
    if (!only.empty() && only != bound.key) continue;
    for (const Expectations* asked : {&expectations, &goal}) {
      const std::optional<double> allowed = bound.asked(*asked);
      if (!allowed) continue;
      const std::optional<double> measured = run.value(bound.metric);
      excess = std::max(excess, measured ? excess_over(bound, *measured, *allowed) : kUnmeasured);
    }
  }
  return excess;
}

void check_bound(const std::string& key, const Expectations& expectations,
                 const Expectations& goal) {
  std::vector<std::string> keys;
  for (const Bound& bound : bounds()) {
    if (bound.asked(expectations) || bound.asked(goal)) keys.emplace_back(bound.key);
  }
  if (std::ranges::find(keys, key) == keys.end()) {
    fail("'{}': expected 'failure' or a bound that the scenario's expectations or goal have{}", key,
         did_you_mean(key, keys));
  }
}

}  // namespace vinebench::harness
