// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/commands/comparison_options.h"

namespace vinebench::tools {

std::vector<Option> comparison_options(ComparisonArguments& arguments) {
  return {{.name = "--metric",
           .target = &arguments.metrics,
           .help = "Metric to look at, by its key in metrics.json (ate_rmse_m, "
                   "loop_closures.wrong) or 'passed'; all of the table by default; may be repeated",
           .type = "METRIC"},
          {.name = "--alpha",
           .target = &arguments.alpha,
           .help = "Probability of any false claim in a table",
           .show_default = true,
           .range = Range::between(1e-6, 0.5)},
          {.name = "--power",
           .target = &arguments.power,
           .help = "Probability with which the seeds that are asked for will tell",
           .show_default = true,
           .range = Range::between(0.5, 0.9999)}};
}

harness::CompareSettings settings_of(const ComparisonArguments& arguments) {
  harness::CompareSettings settings;
  settings.goal = {.alpha = arguments.alpha, .power = arguments.power};
  settings.metrics = harness::parse_metrics(arguments.metrics);
  return settings;
}

}  // namespace vinebench::tools
