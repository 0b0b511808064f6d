// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "core/util/files.h"
#include "harness/report/compare.h"
#include "tools/commands.h"

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
    write_file_atomically(arguments.json, harness::comparison_json(runs).dump(2) + "\n");
  }
  fmt::print("A is {}, B is {}\n{}", arguments.before, arguments.after,
             harness::format_comparison(runs));
  return 0;
}

}  // namespace

void add_compare_command(CLI::App& app, Command& chosen) {
  const auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command =
      app.add_subcommand("compare",
                         "Compare the runs of two folders, scenario by scenario and "
                         "seed by seed");
  command->add_option("A", arguments->before, "Folder of a run or of runs")->required();
  command->add_option("B", arguments->after, "Another such folder")->required();
  command->add_option("--json", arguments->json, "Also write the comparison as JSON")
      ->type_name("FILE");
  command->callback([&chosen, arguments] { chosen = [arguments] { return compare(*arguments); }; });
}

}  // namespace vinebench::tools
