// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/judge/bounds.h"
#include "harness/report/stored_run.h"

namespace vinebench::harness {

/// Fewest seeds that a guard is derived from.
inline constexpr std::size_t kSeedsForGuard = 5;

/// An error's bound is at least this factor above its median, a ratio's this factor from it: ten
/// seeds may be closer together than the next ten.
inline constexpr double kGuardMargin = 1.25;

/// A bound of a guard and the measurement behind it.
struct GuardBound {
  const Bound* bound = nullptr;
  double value = 0;
  double median = 0;
  double worst = 0;  ///< of the seeds
};

/// Bounds of all metrics that every run has measured. A count's bound is the worst of the runs. An
/// error's or a share's is as far from the median as twice the worst of the runs, a ratio's by the
/// logarithm; rounded to three digits, away from the median. Throws Error for fewer runs than
/// kSeedsForGuard.
std::vector<GuardBound> derive_guard(const std::vector<StoredRun>& runs);

/// The block `guard:` of a scenario file, with the measurement as comments.
std::string format_guard(const std::vector<GuardBound>& bounds, const std::string& scenario,
                         const std::string& seeds);

/// The text of a scenario file with this block in place of the one it has, else at its end.
std::string with_guard(const std::string& text, const std::string& block);

/// Throws Error unless a guard can be put into the scenario's file: one that may be written, is no
/// link, and is a scenario still with a block `guard:` at its end. Tries it in a file beside it,
/// which is removed.
void check_guard_place(const std::filesystem::path& scenario);

}  // namespace vinebench::harness
