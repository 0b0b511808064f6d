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

bool is_told(const RunRecord& record, const TagSighting& seen) {
  const auto is_it = [&](const auto& tag) {
    return tag.id == seen.id && tag.family == seen.family;
  };
  return std::ranges::any_of(record.told_tags, is_it) ||
         std::ranges::any_of(record.tags,
                             [&](const WorldTag& tag) { return tag.registered && is_it(tag); });
}

bool is_any_told(const RunRecord& record) {
  return !record.told_tags.empty() || std::ranges::any_of(record.tags, &WorldTag::registered);
}

/// Where the map's frame lies, and the first frame whose error it leaves open.
struct Begin {
  Pose T_map_world;
  std::size_t tick = 0;
};

/// The map's frame is the world's by a registered tag; without any, it is that of the first pose.
std::optional<Begin> begin_of(const RunRecord& record) {
  const auto first = std::ranges::find_if(
      record.ticks, [](const Tick& tick) { return tick.estimate.T_map_body.has_value(); });
  if (first == record.ticks.end()) return std::nullopt;
  const auto tick = static_cast<std::size_t>(first - record.ticks.begin());
  if (std::ranges::any_of(first->estimate.tags,
                          [&](const TagSighting& seen) { return is_told(record, seen); })) {
    return Begin{{}, tick};
  }
  if (is_any_told(record) || !first->truth.known) return std::nullopt;
  return Begin{*first->estimate.T_map_body * first->truth.T_world_body.inverse(), tick + 1};
}

/// Nothing where the covariance cannot be inverted.
std::optional<double> nees(const Tick& tick, const Pose& T_map_world) {
  const Eigen::LDLT<Matrix6d> solver(tick.estimate.covariance);
  if (!solver.isPositive() || solver.vectorD().minCoeff() <= 0) return std::nullopt;
  const Pose error = tick.estimate.T_map_body->inverse() * (T_map_world * tick.truth.T_world_body);
  Vector6d step;
  step << error.translation, log_so3(error.rotation);
  return step.dot(solver.solve(step));
}

}  // namespace

std::optional<Consistency> check_consistency(const RunRecord& record) {
  const std::optional<Begin> begin = begin_of(record);
  if (!begin) return std::nullopt;
  Consistency found;
  bool any_covariance = false;
  for (std::size_t i = begin->tick; i < record.ticks.size(); ++i) {
    const Tick& tick = record.ticks[i];
    if (!tick.truth.known || !tick.estimate.T_map_body) continue;
    any_covariance = any_covariance || !tick.estimate.covariance.isZero(0);
    const auto error = nees(tick, begin->T_map_world);
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
