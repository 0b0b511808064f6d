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

/// m and rad: where a map begins is no surer than that only by definition.
constexpr double kExact = 1e-5;

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

/// Whether the frame saw a told tag and did not reject it.
bool believes_a_told_tag(const RunRecord& record, const Estimate& estimate) {
  return std::ranges::any_of(estimate.tags, [&](const TagSighting& seen) {
    const bool rejected = std::ranges::any_of(estimate.rejected_tags, [&](const RejectedTag& tag) {
      return tag.id == seen.id && tag.family == seen.family && tag.camera == seen.camera;
    });
    return !rejected && is_told(record, seen);
  });
}

/// Whether a covariance says that the pose is where the map begins.
bool is_origin(const Matrix6d& covariance) {
  return covariance.diagonal().maxCoeff() < kExact * kExact;
}

/// Where the map's frame lies, from the first frame whose error that leaves open, to the last.
struct Span {
  Pose T_map_world;
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// The map's frame is the world's by a told tag; without any, it is that of the first pose, and so
/// it is before told tags close a loop if the map begins there.
std::optional<Span> span_of(const RunRecord& record) {
  const auto first = std::ranges::find_if(
      record.ticks, [](const Tick& tick) { return tick.estimate.T_map_body.has_value(); });
  if (first == record.ticks.end()) return std::nullopt;
  const auto begin = static_cast<std::size_t>(first - record.ticks.begin());
  if (believes_a_told_tag(record, first->estimate)) return Span{{}, begin, record.ticks.size()};
  if (!first->truth.known) return std::nullopt;
  Span span{*first->estimate.T_map_body * first->truth.T_world_body.inverse(), begin + 1,
            record.ticks.size()};
  if (!is_any_told(record)) return span;
  if (!is_origin(first->estimate.covariance)) return std::nullopt;
  const auto loop = std::find_if(first, record.ticks.end(), [](const Tick& tick) {
    return tick.estimate.loop_closure.has_value();
  });
  span.end = static_cast<std::size_t>(loop - record.ticks.begin());
  return span;
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
  const std::optional<Span> span = span_of(record);
  if (!span) return std::nullopt;
  Consistency found;
  bool any_covariance = false;
  for (std::size_t i = span->begin; i < span->end; ++i) {
    const Tick& tick = record.ticks[i];
    if (!tick.truth.known || !tick.estimate.T_map_body) continue;
    any_covariance = any_covariance || !tick.estimate.covariance.isZero(0);
    const auto error = nees(tick, span->T_map_world);
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
