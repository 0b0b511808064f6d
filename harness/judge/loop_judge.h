// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "harness/run/run_record.h"

namespace vinebench::harness {

/// Tolerances of a correct closure.
inline constexpr double kLoopClosureMetres = 0.10;
inline constexpr double kLoopClosureDegrees = 2.0;

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
  bool correct = false;
  bool judged = true;  ///< false if the truth of either end is unknown
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
  std::vector<TagVisit> missed;  ///< returns without a closure
  int correct() const;
  int wrong() const;
};

/// Visits according to the truth: of all registered tags together, and of each other tag, in order
/// of time.
std::vector<TagVisit> tag_visits(const RunRecord& record);

LoopVerdict judge_loop_closures(const RunRecord& record);

}  // namespace vinebench::harness
