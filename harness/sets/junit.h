// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "harness/sets/set_report.h"

namespace vinebench::harness {

/// A set's verdicts as JUnit XML: one suite for each scenario, one case for each seed (and
/// repeat), one for the median if it has bounds, and one for repeats that must agree.
std::string format_junit(const std::vector<SeedsSummary>& scenarios);

}  // namespace vinebench::harness
