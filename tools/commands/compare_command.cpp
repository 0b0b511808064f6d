// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "core/files/files.h"
#include "harness/datasets/files/json_file.h"
#include "harness/report/compare.h"
#include "tools/commands/commands.h"

namespace vinebench::tools {
namespace {

struct CompareArguments {
  std::string before;
  std::string after;
  std::string json;
};

int compare(const CompareArguments& arguments) {
  const harness::PairedRuns runs = harness::pair_runs(arguments.before, arguments.after);
  if (!arguments.json.empty()) {
    write_file_atomically(arguments.json,
                          harness::json_text(harness::comparison_json(runs), 2) + "\n");
  }
  fmt::print("A is {}, B is {}\n{}", arguments.before, arguments.after,
             harness::format_comparison(runs));
  return 0;
}

}  // namespace

Command compare_command() {
  const auto arguments = std::make_shared<CompareArguments>();
  return {.name = "compare",
          .description = "Compare the runs of two folders, scenario by scenario and seed by seed",
          .options = {{.name = "A",
                       .target = &arguments->before,
                       .help = "Folder of a run or of runs",
                       .required = true},
                      {.name = "B",
                       .target = &arguments->after,
                       .help = "Another such folder",
                       .required = true},
                      {.name = "--json",
                       .target = &arguments->json,
                       .help = "Also write the comparison as JSON",
                       .type = "FILE"}},
          .run = [arguments] { return compare(*arguments); }};
}

}  // namespace vinebench::tools
