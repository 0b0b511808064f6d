// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/findings/error_pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.h"
#include "core/util/percentile.h"
#include "harness/judge/evaluation.h"

namespace vinebench::harness {
namespace {

constexpr double kShareExplained = 0.6;  // of the squared error, at least
constexpr double kVisible = 0.001;       // m RMS that a fit explains, at least
constexpr double kLeastStep = 0.005;     // m
constexpr double kTimesMedian = 10;      // the median change of the error
constexpr double kLeastNoise = 0.002;    // m RMS
constexpr double kUncorrelated = 0.3;    // autocorrelation of neighbouring frames, at most
constexpr double kLeastTilt = 0.25 * kRadiansPerDegree;
constexpr double kEvenTilt = 2;                             // worst frame over RMS, at most
constexpr double kLeastTurning = 0.25 * kRadiansPerDegree;  // in the end
constexpr double kLeastTurn = 0.5 * kRadiansPerDegree;
constexpr double kInconsistent = 4;  // times the expected NEES

using Vectors = std::vector<Eigen::Vector3d>;

/// Truth and error of each associated frame, aligned by the first pose, m.
struct Course {
  Vectors error;
  Vectors velocity;                   ///< true, m/s
  Vectors displacement;               ///< true, from the first pose
  Vectors climb;                      ///< the path's length upwards
  std::vector<double> heading_error;  ///< rad, to the left
};

Course course_of(const std::vector<PosePair>& pairs, const Pose& T_world_map) {
  Course course;
  double path = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const PosePair& before = pairs[i == 0 ? 0 : i - 1];
    const PosePair& after = pairs[i + 1 == pairs.size() ? i : i + 1];
    const Eigen::Vector3d& at = pairs[i].T_world_body.translation;
    path += (at - before.T_world_body.translation).norm();
    course.error.push_back(T_world_map * pairs[i].T_map_body.translation - at);
    course.velocity.push_back((after.T_world_body.translation - before.T_world_body.translation) /
                              to_seconds(std::max<Stamp>(after.stamp - before.stamp, 1)));
    course.displacement.push_back(at - pairs.front().T_world_body.translation);
    course.climb.push_back(path * Eigen::Vector3d::UnitZ());
    course.heading_error.push_back(heading_between(
        pairs[i].T_world_body.rotation, T_world_map.rotation * pairs[i].T_map_body.rotation));
  }
  return course;
}

double sum_of_products(const Vectors& a, const Vectors& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

/// The best factor of `shape`, if it explains enough.
void add_fit(ErrorPatternKind kind, double sign, const Vectors& shape, const Vectors& error,
             std::vector<ErrorPattern>& patterns) {
  const double squares = sum_of_products(shape, shape);
  const double all = sum_of_products(error, error);
  if (squares <= 0 || all <= 0) return;
  const double product = sum_of_products(shape, error);
  const double explained = product * product / squares;
  if (explained < kShareExplained * all ||
      explained < kVisible * kVisible * static_cast<double>(error.size())) {
    return;
  }
  patterns.push_back({kind, sign * product / squares, explained / all});
}

/// Growing with the path in one horizontal direction.
void add_drift(const Course& course, std::vector<ErrorPattern>& patterns) {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < course.error.size(); ++i) {
    direction += course.climb[i].z() * course.error[i];
  }
  direction.z() = 0;
  if (direction.norm() == 0) return;
  direction.normalize();
  Vectors shape;
  for (const Eigen::Vector3d& climb : course.climb) shape.push_back(climb.z() * direction);
  add_fit(ErrorPatternKind::kDrifting, 1, shape, course.error, patterns);
}

void add_turning(const Course& course, std::vector<ErrorPattern>& patterns) {
  double squares = 0;
  double products = 0;
  double all = 0;
  for (std::size_t i = 0; i < course.heading_error.size(); ++i) {
    squares += course.climb[i].squaredNorm();
    products += course.climb[i].z() * course.heading_error[i];
    all += course.heading_error[i] * course.heading_error[i];
  }
  if (squares == 0 || all == 0) return;
  const double rate = products / squares;
  const double share = products * products / (squares * all);
  if (share < kShareExplained || std::abs(rate) * course.climb.back().z() < kLeastTurning) return;
  patterns.push_back({ErrorPatternKind::kTurning, rate, share});
}

void add_fits(const Course& course, std::vector<ErrorPattern>& patterns) {
  Vectors turned;
  for (const Eigen::Vector3d& d : course.displacement) turned.emplace_back(-d.y(), d.x(), 0);
  std::vector<ErrorPattern> fits;
  add_fit(ErrorPatternKind::kLate, -1, course.velocity, course.error, fits);
  add_fit(ErrorPatternKind::kScale, 1, course.displacement, course.error, fits);
  add_fit(ErrorPatternKind::kTurned, 1, turned, course.error, fits);
  add_fit(ErrorPatternKind::kClimbing, 1, course.climb, course.error, fits);
  add_drift(course, fits);
  std::ranges::stable_sort(fits, std::ranges::greater(), &ErrorPattern::share);
  patterns.insert(patterns.end(), fits.begin(), fits.end());
}

/// Between neighbouring frames of the live estimate, except where a closure corrects it.
void add_step(const RunRecord& record, const RunResults& results,
              std::vector<ErrorPattern>& patterns) {
  const auto pairs = associate(true_trajectory(record), live_trajectory(record));
  if (pairs.size() < 3) return;
  const Pose T_world_map = align_first(pairs);
  std::vector<double> changes;
  ErrorPattern step{ErrorPatternKind::kStep};
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  for (const PosePair& pair : pairs) {
    const Eigen::Vector3d error =
        T_world_map * pair.T_map_body.translation - pair.T_world_body.translation;
    const double change = (error - before).norm();
    before = error;
    changes.push_back(change);
    const bool corrected = std::ranges::any_of(results.loops.closures, [&](const auto& closure) {
      return closure.correct && record.ticks[closure.tick].stamp == pair.stamp;
    });
    if (!corrected && change > step.size) {
      step.size = change;
      step.stamp = pair.stamp;
    }
  }
  if (step.size >= std::max(kLeastStep, kTimesMedian * percentile(changes, 0.5))) {
    patterns.push_back(step);
  }
}

void add_noise(const Vectors& error, std::vector<ErrorPattern>& patterns) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& e : error) mean += e / static_cast<double>(error.size());
  double squares = 0;
  double products = 0;
  for (std::size_t i = 0; i < error.size(); ++i) {
    squares += (error[i] - mean).squaredNorm();
    if (i > 0) products += (error[i] - mean).dot(error[i - 1] - mean);
  }
  const double rms = std::sqrt(squares / static_cast<double>(error.size()));
  if (rms >= kLeastNoise && products <= kUncorrelated * squares) {
    patterns.push_back({ErrorPatternKind::kNoise, rms});
  }
}

void add_tilt(const OrientationErrors& orientation, std::vector<ErrorPattern>& patterns) {
  const AngleStatistics& tilt = orientation.tilt;
  if (tilt.rmse >= kLeastTilt && tilt.max <= kEvenTilt * tilt.rmse) {
    patterns.push_back({ErrorPatternKind::kTilted, tilt.rmse});
  }
}

/// In the world: what aligning the first poses takes away.
void add_world(const std::vector<PosePair>& pairs, const std::optional<Pose>& T_world_map,
               std::vector<ErrorPattern>& patterns) {
  if (!T_world_map) return;
  const double aligned = position_errors(pairs, align_first(pairs)).rmse;
  const double unaligned = position_errors(pairs, *T_world_map).rmse;
  const double share = 1 - std::pow(aligned / std::max(unaligned, 1e-12), 2);
  if (share < kShareExplained || unaligned < kVisible) return;
  const Pose wrong = *T_world_map * pairs.front().T_map_body * pairs.front().T_world_body.inverse();
  const Eigen::Vector3d& at = pairs.front().T_world_body.translation;
  patterns.push_back({ErrorPatternKind::kWorldOffset, (wrong * at - at).norm(), share});
  const double turn = Eigen::AngleAxisd(wrong.rotation).angle();
  if (turn > kLeastTurn) patterns.push_back({ErrorPatternKind::kWorldTurn, turn, share});
}

void add_count(ErrorPatternKind kind, std::ptrdiff_t count, std::vector<ErrorPattern>& patterns) {
  if (count > 0) patterns.push_back({kind, static_cast<double>(count)});
}

void add_consistency(const RunResults& results, std::vector<ErrorPattern>& patterns) {
  if (!results.consistency || results.consistency->frames == 0) return;
  const double ratio = results.consistency->nees_mean / kConsistentNees;
  if (ratio >= kInconsistent) patterns.push_back({ErrorPatternKind::kOverconfident, ratio});
  if (ratio <= 1 / kInconsistent) patterns.push_back({ErrorPatternKind::kUnderconfident, ratio});
}

}  // namespace

const char* name_of(ErrorPatternKind kind) {
  switch (kind) {
    case ErrorPatternKind::kLate:
      return "late";
    case ErrorPatternKind::kScale:
      return "scale";
    case ErrorPatternKind::kTurned:
      return "turned";
    case ErrorPatternKind::kClimbing:
      return "climbing";
    case ErrorPatternKind::kDrifting:
      return "drifting";
    case ErrorPatternKind::kTurning:
      return "turning";
    case ErrorPatternKind::kStep:
      return "step";
    case ErrorPatternKind::kNoise:
      return "noise";
    case ErrorPatternKind::kTilted:
      return "tilted";
    case ErrorPatternKind::kWorldOffset:
      return "world_offset";
    case ErrorPatternKind::kWorldTurn:
      return "world_turn";
    case ErrorPatternKind::kOverconfident:
      return "overconfident";
    case ErrorPatternKind::kUnderconfident:
      return "underconfident";
    case ErrorPatternKind::kLost:
      return "lost";
    case ErrorPatternKind::kWrongLoop:
      return "wrong_loop";
    case ErrorPatternKind::kMissedLoop:
      return "missed_loop";
  }
  return "";
}

std::vector<ErrorPattern> error_patterns(const RunRecord& record, const RunResults& results) {
  std::vector<ErrorPattern> patterns;
  add_count(ErrorPatternKind::kLost, results.losses, patterns);
  add_count(ErrorPatternKind::kWrongLoop, results.loops.wrong(), patterns);
  add_count(ErrorPatternKind::kMissedLoop, std::ssize(results.loops.missed), patterns);
  const auto pairs = associate(true_trajectory(record), record.summary.trajectory);
  if (pairs.size() >= 3) {
    const Course course = course_of(pairs, align_first(pairs));
    add_fits(course, patterns);
    add_turning(course, patterns);
    add_noise(course.error, patterns);
    add_step(record, results, patterns);
    add_world(pairs, record.summary.T_world_map, patterns);
  }
  if (results.corrected) add_tilt(results.corrected->orientation, patterns);
  add_consistency(results, patterns);
  return patterns;
}

std::string text_of(const ErrorPattern& pattern) {
  const double size = pattern.size;
  const std::string share = fmt::format(" ({:.0f} %)", 100 * pattern.share);
  switch (pattern.kind) {
    case ErrorPatternKind::kLate:
      return fmt::format("{:.0f} ms {}{}", 1000 * std::abs(size), size < 0 ? "early" : "late",
                         share);
    case ErrorPatternKind::kScale:
      return fmt::format("scale {:+.1f} %{}", 100 * size, share);
    case ErrorPatternKind::kTurned:
      return fmt::format("path turned by {:+.2f} deg{}", size / kRadiansPerDegree, share);
    case ErrorPatternKind::kClimbing:
      return fmt::format("climbing {:+.1f} % of the path{}", 100 * size, share);
    case ErrorPatternKind::kDrifting:
      return fmt::format("drifting by {:.1f} % of the path{}", 100 * size, share);
    case ErrorPatternKind::kTurning:
      return fmt::format("heading drifting by {:+.2f} deg/m{}", size / kRadiansPerDegree, share);
    case ErrorPatternKind::kStep:
      return fmt::format("a step of {:.0f} mm at {:.2f} s", 1000 * size, to_seconds(pattern.stamp));
    case ErrorPatternKind::kNoise:
      return fmt::format("noise of {:.0f} mm", 1000 * size);
    case ErrorPatternKind::kTilted:
      return fmt::format("tilted by {:.2f} deg", size / kRadiansPerDegree);
    case ErrorPatternKind::kWorldOffset:
      return fmt::format("map {:.0f} mm off in the world{}", 1000 * size, share);
    case ErrorPatternKind::kWorldTurn:
      return fmt::format("map turned by {:.1f} deg in the world", size / kRadiansPerDegree);
    case ErrorPatternKind::kOverconfident:
      return fmt::format("squared errors {:.0f} times what the covariances say", size);
    case ErrorPatternKind::kUnderconfident:
      return fmt::format("squared errors {:.3f} of what the covariances say", size);
    case ErrorPatternKind::kLost:
      return fmt::format("lost {:.0f} times", size);
    case ErrorPatternKind::kWrongLoop:
      return fmt::format("{:.0f} wrong loop closures", size);
    case ErrorPatternKind::kMissedLoop:
      return fmt::format("{:.0f} missed loop closures", size);
  }
  return "";
}

std::string format_patterns(const std::vector<ErrorPattern>& patterns) {
  std::string line;
  for (const ErrorPattern& pattern : patterns) {
    line += (line.empty() ? "pattern of the error: " : ", ") + text_of(pattern);
  }
  return line.empty() ? "" : line + "\n";
}

}  // namespace vinebench::harness
