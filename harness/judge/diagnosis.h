// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/judge/degraded_segments.h"

namespace vinebench::harness {

const char* name_of(Cause cause);

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
