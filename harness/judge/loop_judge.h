// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "harness/run/run_record.h"

namespace vinebench::harness {

/// A correct closure is within these of the truth, whatever its covariance.
inline constexpr double kLoopClosureMetres = 0.10;
inline constexpr double kLoopClosureDegrees = 2.0;
/// If the system gives its covariance, the error is also within the 99.9 % quantile of chi-square
/// with six degrees of freedom, of this covariance and a floor: standard deviations, along and
/// about each axis, of what no covariance of tag corners contains, such as the camera's mounting.
inline constexpr double kClosureChiSquared = 22.458;
inline constexpr double kClosureFloorMetres = 0.005;
inline constexpr double kClosureFloorDegrees = 0.5;

/// A tag is *revisited* after this time and distance without it, and, if it is registered, without
/// any other registered one, because each of them gives the pose.
inline constexpr Stamp kVisitGap = 3 * kNanosecondsPerSecond;
inline constexpr double kVisitGapMetres = 1.0;
/// A visit must lead to a closure if the tag is in view for at least this time.
inline constexpr Stamp kVisitSeconds = kNanosecondsPerSecond;

/// One reported closure against the truth.
struct JudgedClosure {
  std::size_t tick = 0;  ///< at which it was reported
  LoopClosure closure;
  double error_m = 0;  ///< of T_earlier_later
  double error_rad = 0;
  std::optional<double> chi_squared{};  ///< of the error; absent without a covariance
  bool correct = false;
  bool trivial = false;  ///< right, but of frames less than kVisitGap apart
  bool judged = true;    ///< false if the truth of either end is unknown

  /// Off the truth, or by a tag that cannot be seen at both ends.
  bool wrong() const { return judged && !correct && !trivial; }
};

/// A time during which, according to the truth, a tag, or one of the registered tags, is in view,
/// short gaps included.
struct TagVisit {
  int tag = 0;            ///< the first in view, an index into RunRecord::tags
  std::size_t first = 0;  ///< tick
  std::size_t last = 0;   ///< tick
  Stamp longest = 0;      ///< longest uninterrupted view, ns
};

struct LoopVerdict {
  std::vector<JudgedClosure> closures;
  std::vector<TagVisit> missed;  ///< returns without a correct closure
  int returns = 0;               ///< to tags, that must lead to a closure
  int correct() const;
  int wrong() const;
};

/// Visits according to the truth: of all registered tags together, and of each other tag, in order
/// of time.
std::vector<TagVisit> tag_visits(const RunRecord& record);

LoopVerdict judge_loop_closures(const RunRecord& record);

}  // namespace vinebench::harness
