// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "harness/run/run_record.h"

namespace vinebench::harness {

/// A closure agrees with the truth within these, or it is wrong.
inline constexpr double kLoopClosureMetres = 0.10;
inline constexpr double kLoopClosureDegrees = 2.0;

/// A tag is seen *again* after this much time and way without it, and, where it is registered,
/// without any registered one, each of which tells the pose …
inline constexpr Stamp kVisitGap = 3 * kNanosecondsPerSecond;
inline constexpr double kVisitGapMetres = 1.0;
/// … and a visit is one that a system must notice once the tag stayed in view for so long.
inline constexpr Stamp kVisitSeconds = kNanosecondsPerSecond;

/// One reported closure against the truth.
struct JudgedClosure {
  std::size_t tick = 0;  ///< that reported it
  LoopClosure closure;
  double error_m = 0;  ///< of T_earlier_later
  double error_rad = 0;
  bool correct = false;
  bool judged = true;  ///< false where the truth of either end is unknown
};

/// A time during which the truth has a tag, or one of the registered tags, in view, short gaps
/// included.
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

/// Visits by the truth: one after the other of all registered tags, and of each other tag.
std::vector<TagVisit> tag_visits(const RunRecord& record);

LoopVerdict judge_loop_closures(const RunRecord& record);

}  // namespace vinebench::harness
