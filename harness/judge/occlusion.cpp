// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/occlusion.h"

#include <algorithm>

#include "core/util/error.h"

namespace vinebench::harness {
namespace {

bool each_share(const Tick& tick, const std::vector<int>& cameras, auto&& condition) {
  return std::ranges::all_of(cameras, [&](int camera) {
    const auto index = static_cast<std::size_t>(camera);
    return index < tick.truth.occlusion.size() && condition(tick.truth.occlusion[index].total());
  });
}

int inliers_of(const Tick& tick, const std::vector<int>& cameras) {
  int inliers = 0;
  for (const int camera : cameras) {
    const auto index = static_cast<std::size_t>(camera);
    if (index < tick.estimate.cameras.size()) inliers += tick.estimate.cameras[index].inliers;
  }
  return inliers;
}

/// Mean of their inliers over the `selected` ticks; 0 if there is none.
double mean_inliers(const RunRecord& record, const std::vector<int>& cameras, auto&& selected) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < record.ticks.size(); ++i) {
    if (!selected(i)) continue;
    sum += inliers_of(record.ticks[i], cameras);
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

OccluderClass largest_occluder(const RunRecord& record, const OcclusionSegment& segment,
                               const std::vector<int>& cameras) {
  Occlusion sum;
  for (std::size_t i = segment.first; i <= segment.last; ++i) {
    for (const int camera : cameras) {
      const Occlusion& seen = record.ticks[i].truth.occlusion.at(static_cast<std::size_t>(camera));
      for (std::size_t c = 0; c < kOccluderClasses; ++c) sum.shares[c] += seen.shares[c];
    }
  }
  return sum.largest();
}

void describe(OcclusionSegment& segment, const RunRecord& record, const std::vector<int>& cameras,
              double share) {
  segment.occluder = largest_occluder(record, segment, cameras);
  const auto in_segment = [&](std::size_t i) { return i >= segment.first && i <= segment.last; };
  segment.inliers_blind = mean_inliers(record, cameras, in_segment);
  segment.inliers_clear = mean_inliers(record, cameras, [&](std::size_t i) {
    return is_tracked(record.ticks[i].estimate) &&
           each_share(record.ticks[i], cameras, [&](double s) { return s <= share / 2; });
  });
  for (std::size_t i = segment.first; i <= segment.last; ++i) {
    if (!is_tracked(record.ticks[i].estimate)) ++segment.lost_frames;
  }
}

}  // namespace

std::optional<double> OcclusionSegment::inliers_drop() const {
  if (inliers_clear <= 0) return std::nullopt;
  return 1 - inliers_blind / inliers_clear;
}

std::vector<int> find_cameras(const Rig& rig, const std::vector<std::string>& names) {
  std::vector<int> cameras;
  for (const std::string& name : names) {
    const int camera = rig.find_camera(name);
    if (camera < 0) fail("expectations.blind.cameras: the rig has no camera '{}'", name);
    cameras.push_back(camera);
  }
  return cameras;
}

std::optional<OcclusionSegment> longest_occlusion(const RunRecord& record,
                                                  const std::vector<int>& cameras, double share) {
  const std::vector<double> lengths = true_path_lengths(record);
  const auto blind = [&](std::size_t i) {
    return each_share(record.ticks[i], cameras, [&](double s) { return s >= share; });
  };
  std::optional<OcclusionSegment> longest;
  std::size_t begin = 0;
  for (std::size_t i = 1; i < record.ticks.size(); ++i) {
    const double step = to_seconds(record.ticks[i].stamp - record.ticks[i - 1].stamp);
    const bool moving = lengths[i] - lengths[i - 1] >= kMovingSpeed * step;
    if (!moving || !blind(i) || !blind(i - 1)) {
      begin = i;
      continue;
    }
    const double seconds = to_seconds(record.ticks[i].stamp - record.ticks[begin].stamp);
    if (longest && seconds <= longest->seconds) continue;
    longest = OcclusionSegment{
        .first = begin, .last = i, .seconds = seconds, .metres = lengths[i] - lengths[begin]};
  }
  if (longest) describe(*longest, record, cameras, share);
  return longest;
}

}  // namespace vinebench::harness
