// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/consistency.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace vinebench::harness {
namespace {

/// 95 % quantile of the chi-square distribution with six degrees of freedom.
constexpr double kChiSquared6 = 12.592;

bool begins_in_the_world(const RunRecord& record) {
  const auto first = std::ranges::find_if(
      record.ticks, [](const Tick& tick) { return tick.estimate.T_map_body.has_value(); });
  if (first == record.ticks.end()) return false;
  return std::ranges::any_of(first->estimate.tags, [&](const TagSighting& seen) {
    return std::ranges::any_of(record.tags, [&](const WorldTag& tag) {
      return tag.registered && tag.id == seen.id && tag.family == seen.family;
    });
  });
}

/// Nothing where the covariance cannot be inverted, or nothing is known.
std::optional<double> nees(const Tick& tick) {
  if (!tick.truth.known || !tick.estimate.T_map_body) return std::nullopt;
  const Eigen::LDLT<Matrix6d> solver(tick.estimate.covariance);
  if (!solver.isPositive() || solver.vectorD().minCoeff() <= 0) return std::nullopt;
  const Pose error = tick.estimate.T_map_body->inverse() * tick.truth.T_world_body;
  Vector6d step;
  step << error.translation, log_so3(error.rotation);
  return step.dot(solver.solve(step));
}

}  // namespace

std::optional<Consistency> check_consistency(const RunRecord& record) {
  if (!begins_in_the_world(record)) return std::nullopt;
  Consistency found;
  int frames = 0;
  for (const Tick& tick : record.ticks) {
    const auto error = nees(tick);
    if (!error) continue;
    ++frames;
    found.nees_mean += *error;
    found.within_95 += *error <= kChiSquared6 ? 1 : 0;
  }
  if (frames == 0) return std::nullopt;
  found.nees_mean /= frames;
  found.within_95 /= frames;
  return found;
}

}  // namespace vinebench::harness
