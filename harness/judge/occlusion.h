// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "harness/run/run_record.h"

namespace vinebench::harness {

/// Slower than this (m/s) a body stands.
inline constexpr double kMovingSpeed = 0.05;

/// The longest unbroken time in which chosen cameras see almost nothing but carton while the body
/// moves.
struct OcclusionSegment {
  std::size_t first = 0;     ///< tick
  std::size_t last = 0;      ///< tick
  double seconds = 0;        ///< s
  double metres = 0;         ///< m, of the true way
  double inliers_clear = 0;  ///< of these cameras together, mean over frames in clear view
  double inliers_blind = 0;  ///< the same, over the segment
  int lost_frames = 0;       ///< of the segment, without a pose

  /// Share by which the inliers fell; nothing when there were none to lose.
  std::optional<double> inliers_drop() const;
};

/// Names of cameras to indices of the rig. Throws Error for a name that the rig has not.
std::vector<int> find_cameras(const Rig& rig, const std::vector<std::string>& names);

/// Cameras are blind where each one's share of carton is at least `box_share`; their view is clear
/// where each one's is at most half of that. Nothing when they are never blind in motion.
std::optional<OcclusionSegment> longest_occlusion(const RunRecord& record,
                                                  const std::vector<int>& cameras,
                                                  double box_share);

}  // namespace vinebench::harness
