// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/realism/realism_fit.h"

#include <algorithm>
#include <cmath>

#include "core/util/error.h"

namespace vinebench::harness {
namespace {

constexpr double kFarthest = 3;  // halves of the range, beyond which nothing is learned
constexpr int kLeastDraws = 8;

}  // namespace

double distance_of(const Realism& realism) {
  double sum = 0;
  for (const StatisticComparison& s : realism.statistics) {
    const double half = std::max(0.5 * (s.high - s.low), 1e-9);
    sum += std::min(kFarthest, std::abs(s.ours - s.middle) / half);
  }
  return sum / static_cast<double>(std::max<std::size_t>(realism.statistics.size(), 1));
}

RealismFit search_settings(const PictureSet& real, int count,
                           const std::function<PictureSet(std::int64_t draw)>& measure) {
  if (count < kLeastDraws) fail("--fit: expected at least {} draws, found {}", kLeastDraws, count);
  RealismFit fit;
  for (std::int64_t draw = 1; draw <= count; ++draw) {
    const Realism realism = compare_pictures(real, measure(draw));
    fit.tried.push_back({draw, distance_of(realism), realism.inside()});
  }
  std::ranges::stable_sort(fit.tried, {}, &RealismFit::Candidate::distance);
  fit.distance_before = fit.tried[fit.tried.size() / 2].distance;
  for (std::size_t i = 0; i < fit.tried.size() / 4; ++i) fit.nearest.push_back(fit.tried[i].draw);
  return fit;
}

}  // namespace vinebench::harness
