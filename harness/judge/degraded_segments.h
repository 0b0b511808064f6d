// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "harness/judge/diagnosis.h"

namespace vinebench::harness {

/// How fast the body truly moves at a tick.
struct TrueMotion {
  double speed = 0;  ///< m/s
  double turn = 0;   ///< rad/s
};

/// From the tick before to the one after; zeros where the truth is not known.
TrueMotion true_motion(const RunRecord& record, std::size_t tick);

/// How far the pose as it was known moves off the truth from one tick to a later one, m, in the
/// world: both poses of `from` are laid onto each other. Nothing where either end has no pose that
/// cameras bear out, or no truth.
std::optional<Eigen::Vector3d> error_growth(const RunRecord& record, std::size_t from,
                                            std::size_t to);

/// Where the estimate suffered, as diagnose() defines it; without causes.
std::vector<DegradedSegment> degraded_segments(const RunRecord& record, const RunResults& results);

}  // namespace vinebench::harness
