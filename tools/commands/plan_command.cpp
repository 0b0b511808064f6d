// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "core/files/files.h"
#include "core/util/error.h"
#include "harness/comparison/seed_plan.h"
#include "harness/datasets/files/json_file.h"
#include "tools/arguments/options.h"
#include "tools/commands/commands.h"
#include "tools/commands/comparison_options.h"

namespace vinebench::tools {
namespace {

struct PlanArguments {
  std::string runs;
  std::string other;
  std::vector<std::string> detect;
  ComparisonArguments comparison;
  std::string json;
};

std::vector<harness::MetricPlan> plans_of(const PlanArguments& arguments,
                                          const harness::CompareSettings& settings) {
  try {
    return arguments.other.empty()
               ? harness::plan_seeds(harness::find_runs(arguments.runs), settings)
               : harness::plan_seeds(harness::pair_runs(arguments.runs, arguments.other).pairs,
                                     settings);
  } catch (const Error& error) {
    const std::string message = error.what();
    if (message.starts_with(arguments.runs)) throw;
    fail("{}: {}", arguments.runs, message);
  }
}

int plan(const PlanArguments& arguments) {
  harness::CompareSettings settings = settings_of(arguments.comparison);
  settings.margins = harness::parse_margins(arguments.detect, "--detect");
  const std::vector<harness::MetricPlan> plans = plans_of(arguments, settings);
  if (!arguments.json.empty()) {
    write_file_atomically(arguments.json,
                          harness::json_text(harness::plan_json(plans, settings), 2) + "\n");
  }
  fmt::print("{}", harness::format_plan(plans, settings));
  if (arguments.other.empty()) {
    fmt::print(
        "from one system, as if the other had nothing in common with it: usually an upper bound; "
        "`plan A B` measures the difference\n");
  }
  return 0;
}

}  // namespace

Command plan_command() {
  const auto arguments = std::make_shared<PlanArguments>();
  Command command{
      .name = "plan",
      .description = "Say how many seeds a comparison needs, by the spread of runs that are there",
      .options = {{.name = "RUNS",
                   .target = &arguments->runs,
                   .help = "Folder of runs of several seeds",
                   .required = true},
                  {.name = "OTHER",
                   .target = &arguments->other,
                   .help = "Folder of another system's runs of the same scenarios and seeds"},
                  {.name = "--detect",
                   .target = &arguments->detect,
                   .help = "Change to be detected, of all metrics (10%) or of one "
                           "(ate_rmse_m=5%, or in its unit: ate_rmse_m=2); may be repeated",
                   .type = "[METRIC=]VALUE",
                   .required = true}},
      .run = [arguments] { return plan(*arguments); }};
  append(command.options, comparison_options(arguments->comparison));
  command.options.push_back({.name = "--json",
                             .target = &arguments->json,
                             .help = "Also write the plan as JSON",
                             .type = "FILE"});
  return command;
}

}  // namespace vinebench::tools
