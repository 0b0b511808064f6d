// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "core/truth/occlusion.h"
#include "harness/judge/results.h"

namespace vinebench::harness {

/// Causes of a degraded segment, according to the truth.
enum class Cause {
  kDroppedImages,     ///< cameras gave no image
  kOcclusion,         ///< occluders cover at least half of a camera's image
  kMotionBlur,        ///< the scene moved by pixels during the exposure
  kLittleTexture,     ///< a camera with a clear view found few features
  kWrongTag,          ///< a wrong loop closure, or a tag that contradicts the map
  kMissedTag,         ///< a tag was in view and not detected
  kExposure,          ///< dark or saturated images, or much gain
  kMovingObjects,     ///< something that moves covers a part of a camera's image
  kRollingShutter,    ///< the scene moved by pixels from the first row's exposure to the last's
  kTimeOffset,        ///< stamps, or the instants of a pair's cameras, differ by what is visible
  kRepeatedPattern,   ///< many matches, and an error that grew by a multiple of the plants' spacing
  kCalibrationError,  ///< none of these, and the true rig differs from the nominal one
  kUnexplained,
};

/// A degraded segment of the run with one of its causes.
struct DegradedSegment {
  std::size_t first = 0;  ///< tick
  std::size_t last = 0;   ///< tick
  Cause cause = Cause::kUnexplained;
  std::vector<std::size_t>
      cameras{};  ///< of the rig, affected by the cause; empty: not camera-specific
  std::optional<OccluderClass>
      occluder{};            ///< the class that covers most; of kOcclusion and kMovingObjects
  double share = 0;          ///< of the segment's ticks in which it is present, 0 to 1
  double error_growth = 0;   ///< m, drift of the live pose during the segment
  int untracked = 0;         ///< frames without a pose supported by cameras
  double inliers = 0;        ///< of all cameras, mean over the segment
  double usual_inliers = 0;  ///< the run's median
};

/// True velocity of the body at a tick.
struct TrueMotion {
  double speed = 0;  ///< m/s
  double turn = 0;   ///< rad/s
};

/// Between the previous and the next tick; zeros if the truth is unknown.
TrueMotion true_motion(const RunRecord& record, std::size_t tick);

/// Drift of the live pose from one tick to a later one, m, in the world, with true and estimated
/// pose aligned at `from`. Empty if either end has no pose supported by cameras, or no truth.
std::optional<Eigen::Vector3d> error_growth(const RunRecord& record, std::size_t from,
                                            std::size_t to);

/// The degraded segments of an estimate, as diagnose() defines them, without causes.
std::vector<DegradedSegment> degraded_segments(const RunRecord& record, const RunResults& results);

}  // namespace vinebench::harness
