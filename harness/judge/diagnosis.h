// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "harness/judge/results.h"

namespace vinebench::harness {

/// What the truth says was amiss while an estimate suffered.
enum class Cause {
  kDroppedImages,     ///< cameras gave no image
  kOcclusion,         ///< cartons fill half of a camera's image and more
  kMotionBlur,        ///< while an image was exposed what it shows moved by pixels
  kLittleTexture,     ///< a camera that sees freely found few features
  kWrongTag,          ///< a loop closed wrongly, or a tag that is not where the map has it
  kMissedTag,         ///< a tag was in view and not read
  kRepeatedPattern,   ///< many matches, and an error that grew by a multiple of the plants' spacing
  kCalibrationError,  ///< nothing of these, and the rig is not the one that the system was told
  kUnexplained,
};
const char* name_of(Cause cause);

/// A segment of the run in which the estimate suffered, with one of its causes.
struct DegradedSegment {
  std::size_t first = 0;  ///< tick
  std::size_t last = 0;   ///< tick
  Cause cause = Cause::kUnexplained;
  std::vector<std::size_t> cameras{};  ///< of the rig, that the cause shows in; empty: not of one
  double share = 0;                    ///< of the segment's ticks that it shows in, 0 to 1
  double error_growth = 0;   ///< m, how far the pose as it was known moved off the truth meanwhile
  int untracked = 0;         ///< frames without a pose that cameras bear out
  double inliers = 0;        ///< of all cameras, mean over the segment
  double usual_inliers = 0;  ///< the run's median
};

/// Finds the segments and their causes. Tracking is weak where there is no pose after the first
/// one, or fewer inliers than a third of the run's median; the error grows fast where in a second
/// the estimated motion is off the true one by 10 mm and more, and by five times the run's median,
/// or by 1.5 % of the way and at least 5 mm.
/// Both are of the poses as they were known at their own frame. Such ticks, with gaps of up to half
/// a second, make a segment; a cause is named when it shows in a third of it, the strongest first.
/// Empty where the truth is not known.
std::vector<DegradedSegment> diagnose(const RunRecord& record, const RunResults& results,
                                      const Trial& trial);

/// For people: a line a segment and cause; one line when there is none.
std::string format_diagnosis(const RunRecord& record, const std::vector<DegradedSegment>& segments);

}  // namespace vinebench::harness
