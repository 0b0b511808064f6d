// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "harness/judge/results.h"

namespace vinebench::harness {

/// One expectation with the measured value.
struct Check {
  std::string what;
  std::string measured;
  std::string expected;
  bool ok = false;
};

std::vector<Check> check_expectations(const Expectations& expectations, const RunResults& results);

bool all_hold(const std::vector<Check>& checks);

/// Those that are not met.
std::vector<Check> failed_of(const std::vector<Check>& checks);

/// A human-readable table, one line per check; empty if there is none.
std::string format_checks(const std::vector<Check>& checks);

}  // namespace vinebench::harness
