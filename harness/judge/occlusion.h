// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "harness/run/run_record.h"

namespace vinebench::harness {

/// Below this speed (m/s) the body counts as stationary.
inline constexpr double kMovingSpeed = 0.05;

/// The longest continuous time in which occluders cover the selected cameras while the body moves.
struct OcclusionSegment {
  std::size_t first = 0;     ///< tick
  std::size_t last = 0;      ///< tick
  double seconds = 0;        ///< s
  double metres = 0;         ///< m, of the true path
  double inliers_clear = 0;  ///< sum over these cameras, mean over frames with a clear view
  double inliers_blind = 0;  ///< the same, over the segment
  int lost_frames = 0;       ///< of the segment, without a pose
  OccluderClass occluder = OccluderClass::kCarton;  ///< the class that covers most

  /// Share by which the inliers dropped; empty if there were none with a clear view.
  std::optional<double> inliers_drop() const;
};

/// Names of cameras to indices of the rig. Throws Error for a name that the rig does not have.
std::vector<int> find_cameras(const Rig& rig, const std::vector<std::string>& names);

/// Cameras are blind if occluders cover at least `share` of each one's image; their view is clear
/// if they cover at most half of that. Empty if they are never blind in motion.
std::optional<OcclusionSegment> longest_occlusion(const RunRecord& record,
                                                  const std::vector<int>& cameras, double share);

}  // namespace vinebench::harness
