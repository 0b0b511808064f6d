// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
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
  kRepeatedPattern,   ///< many matches, and an error that grew by a multiple of the plants' spacing
  kCalibrationError,  ///< none of these, and the true rig differs from the nominal one
  kUnexplained,
};
const char* name_of(Cause cause);

/// A degraded segment of the run with one of its causes.
struct DegradedSegment {
  std::size_t first = 0;  ///< tick
  std::size_t last = 0;   ///< tick
  Cause cause = Cause::kUnexplained;
  std::vector<std::size_t>
      cameras{};  ///< of the rig, affected by the cause; empty: not camera-specific
  std::optional<OccluderClass> occluder{};  ///< the class that covers most; of kOcclusion alone
  double share = 0;          ///< of the segment's ticks in which it is present, 0 to 1
  double error_growth = 0;   ///< m, drift of the live pose during the segment
  int untracked = 0;         ///< frames without a pose supported by cameras
  double inliers = 0;        ///< of all cameras, mean over the segment
  double usual_inliers = 0;  ///< the run's median
};

/// Finds the segments and their causes. Tracking is weak if there is no pose after the first one,
/// or fewer inliers than a third of the run's median. The error grows fast if within a second the
/// estimated motion differs from the true one by at least 10 mm and five times the run's median, or
/// by 1.5 % of the distance travelled and at least 5 mm. Both use the live poses. Such ticks, with
/// gaps of up to half a second, form a segment; a cause is named if it is present in a third of it,
/// the strongest first. Empty if the truth is unknown.
std::vector<DegradedSegment> diagnose(const RunRecord& record, const RunResults& results,
                                      const Trial& trial);

/// Human-readable: one line for each segment and cause; one line if there is none.
std::string format_diagnosis(const RunRecord& record, const std::vector<DegradedSegment>& segments);

}  // namespace vinebench::harness
