// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/evaluation.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/util/error.h"
#include "core/util/percentile.h"

namespace vinebench::harness {
namespace {

/// The segment's end: of the poses after `from`, the first whose path length is nearest to
/// `target`.
std::size_t nearest_in_length(const std::vector<double>& lengths, std::size_t from, double target) {
  const auto begin = lengths.begin() + static_cast<std::ptrdiff_t>(from) + 1;
  auto after = std::lower_bound(begin, lengths.end(), target);
  if (after == lengths.end() || (after != begin && target - *std::prev(after) <= *after - target)) {
    after = std::lower_bound(begin, after, *std::prev(after));
  }
  return static_cast<std::size_t>(after - lengths.begin());
}

std::vector<double> lengths_of(const std::vector<PosePair>& pairs) {
  std::vector<double> lengths(pairs.size(), 0.0);
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    lengths[i] = lengths[i - 1] +
                 (pairs[i].T_world_body.translation - pairs[i - 1].T_world_body.translation).norm();
  }
  return lengths;
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Its square to the sum in `rmse`.
void add(double angle, AngleStatistics& statistics) {
  statistics.rmse += angle * angle;
  statistics.max = std::max(statistics.max, std::abs(angle));
}

double segment_error(const PosePair& from, const PosePair& to) {
  const Pose truth = from.T_world_body.inverse() * to.T_world_body;
  const Pose estimate = from.T_map_body.inverse() * to.T_map_body;
  return (truth.inverse() * estimate).translation.norm();
}

}  // namespace

const StampedPose& nearest_in_time(const Trajectory& trajectory, Stamp stamp) {
  auto after = std::ranges::lower_bound(trajectory, stamp, {}, &StampedPose::stamp);
  if (after == trajectory.begin()) return *after;
  const auto before = std::prev(after);
  if (after == trajectory.end()) return *before;
  return stamp - before->stamp <= after->stamp - stamp ? *before : *after;
}

std::vector<PosePair> associate(const Trajectory& truth, const Trajectory& estimate,
                                Stamp tolerance) {
  std::vector<PosePair> pairs;
  if (truth.empty() || estimate.empty()) return pairs;
  const bool estimate_is_shorter = estimate.size() < truth.size();
  for (const StampedPose& one : estimate_is_shorter ? estimate : truth) {
    const StampedPose& other = nearest_in_time(estimate_is_shorter ? truth : estimate, one.stamp);
    if (std::abs(other.stamp - one.stamp) > tolerance) continue;
    const StampedPose& t = estimate_is_shorter ? other : one;
    const StampedPose& e = estimate_is_shorter ? one : other;
    pairs.push_back({t.stamp, t.pose, e.pose});
  }
  return pairs;
}

Pose align_se3(const std::vector<PosePair>& pairs) {
  Eigen::Matrix3Xd map(3, pairs.size());
  Eigen::Matrix3Xd world(3, pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    map.col(static_cast<Eigen::Index>(i)) = pairs[i].T_map_body.translation;
    world.col(static_cast<Eigen::Index>(i)) = pairs[i].T_world_body.translation;
  }
  const Eigen::Matrix4d T = Eigen::umeyama(map, world, false);
  const Eigen::Matrix3d R = T.topLeftCorner<3, 3>();
  return {Eigen::Quaterniond(R).normalized(), T.topRightCorner<3, 1>()};
}

Pose align_first(const std::vector<PosePair>& pairs) {
  return pairs.front().T_world_body * pairs.front().T_map_body.inverse();
}

ErrorStatistics position_errors(const std::vector<PosePair>& pairs, const Pose& T_world_map) {
  std::vector<double> errors;
  double sum = 0;
  double sum_of_squares = 0;
  for (const PosePair& pair : pairs) {
    const double error =
        (T_world_map * pair.T_map_body.translation - pair.T_world_body.translation).norm();
    errors.push_back(error);
    sum += error;
    sum_of_squares += error * error;
  }
  std::ranges::sort(errors);
  const std::size_t n = errors.size();
  const double median = (errors[(n - 1) / 2] + errors[n / 2]) / 2;
  const double count = static_cast<double>(n);
  return {std::sqrt(sum_of_squares / count), sum / count, median, errors.back(),
          percentile(errors, 0.95)};
}

std::optional<double> relative_error_percent(const std::vector<PosePair>& pairs, double delta) {
  const std::vector<double> lengths = lengths_of(pairs);
  double sum = 0;
  int segments = 0;
  for (std::size_t i = 0; i + 1 < pairs.size(); ++i) {
    const std::size_t end = nearest_in_length(lengths, i, lengths[i] + delta);
    if (std::abs(lengths[end] - lengths[i] - delta) > 0.1 * delta) continue;
    sum += segment_error(pairs[i], pairs[end]);
    ++segments;
  }
  if (segments == 0) return std::nullopt;
  return 100 * sum / (segments * delta);
}

double heading_between(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
  const Eigen::Vector3d a = from * Eigen::Vector3d::UnitX();
  const Eigen::Vector3d b = to * Eigen::Vector3d::UnitX();
  return std::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y());
}

OrientationErrors orientation_errors(const std::vector<PosePair>& pairs, const Pose& T_world_map) {
  OrientationErrors errors;
  for (const PosePair& pair : pairs) {
    const Eigen::Quaterniond estimate = T_world_map.rotation * pair.T_map_body.rotation;
    const Eigen::Quaterniond& truth = pair.T_world_body.rotation;
    add(heading_between(truth, estimate), errors.heading);
    add(angle_between(truth * Eigen::Vector3d::UnitZ(), estimate * Eigen::Vector3d::UnitZ()),
        errors.tilt);
  }
  const double count = static_cast<double>(pairs.size());
  for (AngleStatistics* of : {&errors.heading, &errors.tilt})
    of->rmse = std::sqrt(of->rmse / count);
  return errors;
}

WorstFrame worst_frame(const std::vector<PosePair>& pairs, const Pose& T_world_map) {
  WorstFrame worst{.stamp = pairs.front().stamp};
  for (const PosePair& pair : pairs) {
    const double error =
        (T_world_map * pair.T_map_body.translation - pair.T_world_body.translation).norm();
    if (error > worst.error) worst = {pair.stamp, error};
  }
  return worst;
}

std::optional<Evaluation> evaluate(const Trajectory& truth, const Trajectory& estimate,
                                   const std::optional<Pose>& T_world_map) {
  const std::vector<PosePair> pairs = associate(truth, estimate);
  if (pairs.size() < 3) return std::nullopt;
  Evaluation evaluation;
  evaluation.pairs = pairs.size();
  evaluation.T_world_map = align_se3(pairs);
  evaluation.ate = position_errors(pairs, evaluation.T_world_map);
  const Pose by_first = align_first(pairs);
  evaluation.origin = position_errors(pairs, by_first);
  evaluation.orientation = orientation_errors(pairs, by_first);
  evaluation.worst = worst_frame(pairs, by_first);
  evaluation.rpe_trans_percent = relative_error_percent(pairs);
  if (T_world_map) {
    evaluation.world = {position_errors(pairs, *T_world_map),
                        orientation_errors(pairs, *T_world_map)};
  }
  return evaluation;
}

std::optional<Drift> drift_before(Stamp until, const Trajectory& truth, const Trajectory& live) {
  std::vector<PosePair> pairs = associate(truth, live);
  std::erase_if(pairs, [&](const PosePair& pair) { return pair.stamp >= until; });
  if (pairs.size() < 2) return std::nullopt;
  Drift drift{.error = worst_frame(pairs, align_first(pairs)).error};
  const double path = lengths_of(pairs).back();
  if (path > 0) drift.percent = 100 * drift.error / path;
  return drift;
}

}  // namespace vinebench::harness
