// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "harness/judge/diagnosis.h"

namespace vinebench::harness {

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
