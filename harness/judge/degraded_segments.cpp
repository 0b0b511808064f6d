// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/degraded_segments.h"

#include <algorithm>

#include "core/util/percentile.h"

namespace vinebench::harness {
namespace {

constexpr double kWeak = 1.0 / 3;                  // of the run's median of inliers
constexpr Stamp kWindow = kNanosecondsPerSecond;   // ns, over which growth is measured
constexpr Stamp kGap = kNanosecondsPerSecond / 2;  // ns, bridged within a segment
constexpr double kFastGrowth = 0.010;              // m a window, at least
constexpr double kTimesUsual = 5;                  // and this multiple of the run's median
constexpr double kDrift = 0.015;       // of the distance travelled, for a continuous time,
constexpr double kLeastDrift = 0.005;  // and m a window, above the noise of poses

bool is_known(const Tick& tick) {
  return tick.truth.known && is_tracked(tick.estimate);
}

double inliers_of(const Tick& tick) {
  double inliers = 0;
  for (const CameraCounts& camera : tick.estimate.cameras) inliers += camera.inliers;
  return inliers;
}

double usual_inliers(const RunRecord& record) {
  std::vector<double> counts;
  for (const Tick& tick : record.ticks) {
    if (is_tracked(tick.estimate)) counts.push_back(inliers_of(tick));
  }
  return counts.empty() ? 0 : percentile(counts, 0.5);
}

/// A correct correction moves the pose by the error that it removes.
bool is_corrected(const RunResults& results, std::size_t from, std::size_t to) {
  return std::ranges::any_of(results.loops.closures, [&](const JudgedClosure& closure) {
    return closure.correct && closure.tick > from && closure.tick <= to;
  });
}

/// Ticks of weak tracking.
void mark_weak(const RunRecord& record, double usual, std::vector<bool>& bad) {
  bool had_pose = false;
  for (std::size_t i = 0; i < record.ticks.size(); ++i) {
    const Estimate& estimate = record.ticks[i].estimate;
    had_pose = had_pose || is_tracked(estimate);
    bad[i] = had_pose && (!is_tracked(estimate) || inliers_of(record.ticks[i]) < kWeak * usual);
  }
}

struct Growth {
  std::size_t from = 0;  ///< tick
  std::size_t to = 0;    ///< tick
  double metres = 0;
  double distance = 0;  ///< m, between the true positions
};

std::vector<Growth> growths_of(const RunRecord& record, const RunResults& results) {
  std::vector<Growth> growths;
  std::size_t from = 0;
  for (std::size_t to = 0; to < record.ticks.size(); ++to) {
    while (record.ticks[from].stamp < record.ticks[to].stamp - kWindow) ++from;
    if (record.ticks[to].stamp < record.ticks.front().stamp + kWindow) continue;
    const auto growth = error_growth(record, from, to);
    if (!growth || is_corrected(results, from, to)) continue;
    const double distance = (record.ticks[to].truth.T_world_body.translation -
                             record.ticks[from].truth.T_world_body.translation)
                                .norm();
    growths.push_back({from, to, growth->norm(), distance});
  }
  return growths;
}

/// Ticks of windows in which the error grew fast, or by too large a share of the distance
/// travelled.
void mark_growth(const std::vector<Growth>& growths, std::vector<bool>& bad) {
  if (growths.empty()) return;
  std::vector<double> metres;
  for (const Growth& growth : growths) metres.push_back(growth.metres);
  const double fast = std::max(kFastGrowth, kTimesUsual * percentile(metres, 0.5));
  for (const Growth& growth : growths) {
    const double drift = std::max(kLeastDrift, kDrift * growth.distance);
    if (growth.metres < fast && growth.metres < drift) continue;
    for (std::size_t i = growth.from + 1; i <= growth.to; ++i) bad[i] = true;
  }
}

/// From the last known pose before a segment to the first one after it, or between its own ends.
double growth_over(const RunRecord& record, std::size_t first, std::size_t last) {
  std::size_t from = first == 0 ? 0 : first - 1;
  std::size_t to = last;
  while (from > 0 && !is_known(record.ticks[from])) --from;
  while (to + 1 < record.ticks.size() && !is_known(record.ticks[to])) ++to;
  const auto growth = error_growth(record, from, to);
  return growth ? growth->norm() : 0;
}

void describe(const RunRecord& record, DegradedSegment& segment) {
  double sum = 0;
  for (std::size_t i = segment.first; i <= segment.last; ++i) {
    sum += inliers_of(record.ticks[i]);
    if (!is_tracked(record.ticks[i].estimate)) ++segment.untracked;
  }
  segment.inliers = sum / static_cast<double>(segment.last - segment.first + 1);
  segment.error_growth = growth_over(record, segment.first, segment.last);
}

}  // namespace

TrueMotion true_motion(const RunRecord& record, std::size_t tick) {
  const Tick& before = record.ticks[tick == 0 ? 0 : tick - 1];
  const Tick& after = record.ticks[std::min(tick + 1, record.ticks.size() - 1)];
  const double seconds = to_seconds(after.stamp - before.stamp);
  if (seconds <= 0 || !before.truth.known || !after.truth.known) return {};
  const Pose step = before.truth.T_world_body.inverse() * after.truth.T_world_body;
  return {step.translation.norm() / seconds, angle_of(step.rotation) / seconds};
}

std::optional<Eigen::Vector3d> error_growth(const RunRecord& record, std::size_t from,
                                            std::size_t to) {
  const Tick& begin = record.ticks[from];
  const Tick& end = record.ticks[to];
  if (!is_known(begin) || !is_known(end)) return std::nullopt;
  const Pose T_world_map = begin.truth.T_world_body * begin.estimate.T_map_body->inverse();
  return T_world_map * end.estimate.T_map_body->translation - end.truth.T_world_body.translation;
}

std::vector<DegradedSegment> degraded_segments(const RunRecord& record, const RunResults& results) {
  const bool any_truth =
      std::ranges::any_of(record.ticks, [](const Tick& tick) { return tick.truth.known; });
  if (!any_truth) return {};
  const double usual = usual_inliers(record);
  std::vector<bool> bad(record.ticks.size());
  mark_weak(record, usual, bad);
  mark_growth(growths_of(record, results), bad);
  std::vector<DegradedSegment> segments;
  for (std::size_t i = 0; i < bad.size(); ++i) {
    if (!bad[i]) continue;
    const bool goes_on = !segments.empty() &&
                         record.ticks[i].stamp - record.ticks[segments.back().last].stamp <= kGap;
    if (!goes_on) {
      DegradedSegment segment;
      segment.first = i;
      segment.usual_inliers = usual;
      segments.push_back(segment);
    }
    segments.back().last = i;
  }
  for (DegradedSegment& segment : segments) describe(record, segment);
  return segments;
}

}  // namespace vinebench::harness
