// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "harness/sets/set_report.h"

namespace vinebench::harness {

/// A set's verdicts as JUnit's XML: a suite a scenario, a case a seed and one for the median where
/// it is judged.
std::string format_junit(const std::vector<SeedsSummary>& scenarios);

}  // namespace vinebench::harness
