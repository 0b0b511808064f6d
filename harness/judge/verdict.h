// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "harness/judge/results.h"

namespace vinebench::harness {

/// Why something is asked of a run.
enum class CheckKind {
  kExpectation,  ///< a user's own
  kGoal,         ///< what the scenario exists to show
  kGuard,        ///< what earlier runs of the scenario measured, and some more
  kNow,          ///< what is reached of a goal that is still open
};

/// "expectation", "goal", "guard", "now".
const char* name_of(CheckKind kind);
/// kExpectation for any other name.
CheckKind kind_of(const std::string& name);

/// One expectation with the measured value.
struct Check {
  std::string what;
  std::string measured;
  std::string expected;
  bool ok = false;
  CheckKind kind = CheckKind::kExpectation;
  bool open = false;  ///< a goal, not met, whose bound for now is

  bool holds() const { return ok || open; }
};

std::vector<Check> check_expectations(const Expectations& expectations, const RunResults& results,
                                      CheckKind kind = CheckKind::kExpectation);

/// Expectations, goal, what is reached of it now, and guard, in this order.
std::vector<Check> check_trial(const Trial& trial, const RunResults& results);

/// "PASSED", "PASSED (goal open)", or "FAILED" with the kinds of what failed, such as "FAILED
/// (goal, guard)"; for expectations alone only "FAILED".
std::string verdict_of(const std::vector<Check>& checks);

bool all_hold(const std::vector<Check>& checks);

/// A goal is open.
bool goal_open(const std::vector<Check>& checks);

/// A goal that is not met is open if the bound of the same metric for now is met.
void mark_open_goals(std::vector<Check>& checks);

/// Those that do not hold.
std::vector<Check> failed_of(const std::vector<Check>& checks);

/// A human-readable table, one line per check, with its kind if it is no expectation; empty if
/// there is none.
std::string format_checks(const std::vector<Check>& checks);

}  // namespace vinebench::harness
