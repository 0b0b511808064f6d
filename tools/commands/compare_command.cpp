// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "core/files/files.h"
#include "harness/comparison/comparison_report.h"
#include "harness/datasets/files/json_file.h"
#include "tools/arguments/options.h"
#include "tools/commands/commands.h"
#include "tools/commands/comparison_options.h"

namespace vinebench::tools {
namespace {

struct CompareArguments {
  std::string before;
  std::string after;
  std::vector<std::string> margins;
  ComparisonArguments comparison;
  std::string json;
};

int compare(const CompareArguments& arguments) {
  harness::CompareSettings settings = settings_of(arguments.comparison);
  settings.margins = harness::parse_margins(arguments.margins, "--margin");
  const harness::PairedRuns runs = harness::pair_runs(arguments.before, arguments.after);
  if (!arguments.json.empty()) {
    write_file_atomically(arguments.json,
                          harness::json_text(harness::comparison_json(runs, settings), 2) + "\n");
  }
  fmt::print("A is {}, B is {}\n{}", arguments.before, arguments.after,
             harness::format_comparison(runs, settings));
  return 0;
}

}  // namespace

Command compare_command() {
  const auto arguments = std::make_shared<CompareArguments>();
  Command command{
      .name = "compare",
      .description = "Compare the runs of two folders, scenario by scenario and seed by seed",
      .options = {{.name = "A",
                   .target = &arguments->before,
                   .help = "Folder of a run or of runs",
                   .required = true},
                  {.name = "B",
                   .target = &arguments->after,
                   .help = "Another such folder",
                   .required = true},
                  {.name = "--margin",
                   .target = &arguments->margins,
                   .help = "Difference that does not matter, of all metrics (5%) or of one "
                           "(ate_rmse_m=5%, or in its unit: ate_rmse_m=2); 10% by default; may be "
                           "repeated",
                   .type = "[METRIC=]VALUE"}},
      .run = [arguments] { return compare(*arguments); }};
  append(command.options, comparison_options(arguments->comparison));
  command.options.push_back({.name = "--json",
                             .target = &arguments->json,
                             .help = "Also write the comparison as JSON",
                             .type = "FILE"});
  return command;
}

}  // namespace vinebench::tools
