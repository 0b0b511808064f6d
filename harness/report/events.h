// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "harness/judge/diagnosis.h"

namespace vinebench::harness {

/// The run's log, a JSON object a line in order of time: keyframes, occlusions by the truth (a
/// camera of which occluders cover at least `box_share`), tag sightings and rejected ones, loop
/// closures, losses, causes of degraded segments, and faults of the source's data. Each has `t`
/// (s), `frame` and `event`.
std::string format_events(const RunRecord& record, const RunResults& results,
                          const std::vector<DegradedSegment>& segments, double box_share);

}  // namespace vinebench::harness
