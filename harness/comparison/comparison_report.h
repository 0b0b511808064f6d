// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "harness/comparison/compare.h"

namespace vinebench::harness {

/// Human-readable: each scenario separately, and all together if there are several.
std::string format_comparison(const PairedRuns& runs, const CompareSettings& settings);

/// The same as data: every number behind the verdicts, with the values of each pair.
Json comparison_json(const PairedRuns& runs, const CompareSettings& settings);

}  // namespace vinebench::harness
