// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "harness/comparison/compare.h"
#include "tools/arguments/command.h"

namespace vinebench::tools {

/// What `compare` and `plan` have in common.
struct ComparisonArguments {
  std::vector<std::string> metrics;
  double alpha = harness::TestGoal{}.alpha;
  double power = harness::TestGoal{}.power;
};

/// --metric, --alpha, --power.
std::vector<Option> comparison_options(ComparisonArguments& arguments);

/// Without margins. Throws Error for an unknown metric.
harness::CompareSettings settings_of(const ComparisonArguments& arguments);

}  // namespace vinebench::tools
