// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/consistency.h"

#include <fmt/format.h>

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

/// Nothing where the covariance cannot be inverted.
std::optional<double> nees(const Tick& tick) {
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
  bool any_covariance = false;
  for (const Tick& tick : record.ticks) {
    if (!tick.truth.known || !tick.estimate.T_map_body) continue;
    any_covariance = any_covariance || !tick.estimate.covariance.isZero(0);
    const auto error = nees(tick);
    if (!error) {
      ++found.not_invertible;
      continue;
    }
    ++found.frames;
    found.nees_mean += *error;
    found.within_95 += *error <= kChiSquared6 ? 1 : 0;
  }
  if (!any_covariance) return std::nullopt;
  if (found.frames == 0) return found;
  found.nees_mean /= found.frames;
  found.within_95 /= found.frames;
  return found;
}

std::string format_left_out(const std::optional<Consistency>& consistency) {
  if (!consistency || consistency->not_invertible == 0) return "";
  return fmt::format(
      "consistency: {} of {} frames with a pose are left out, for their covariance "
      "cannot be inverted\n",
      consistency->not_invertible, consistency->frames + consistency->not_invertible);
}

}  // namespace vinebench::harness
