// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "core/util/error.h"
#include "tools/commands/commands.h"
#include "tools/commands/report/open_page.h"

namespace vinebench::tools {
namespace {

struct ReportArguments {
  std::vector<std::string> folders;
  std::filesystem::path history;
  std::filesystem::path out;
  double megabytes = 20;
  bool open = false;
};

std::filesystem::path file_of(const ReportArguments& arguments) {
  if (!arguments.out.empty()) return arguments.out;
  if (arguments.folders.empty()) return arguments.history / kReportFile;
  return std::filesystem::path(arguments.folders.front()) / kReportFile;
}

int report(const ReportArguments& arguments) {
  if (arguments.folders.empty() && arguments.history.empty()) {
    fail("report: expected a folder of runs, or --history FOLDER");
  }
  const std::filesystem::path file = file_of(arguments);
  write_report(file, {{arguments.folders.begin(), arguments.folders.end()},
                      arguments.history,
                      static_cast<std::size_t>(1e6 * arguments.megabytes)});
  if (arguments.open) open_page(file);
  return 0;
}

}  // namespace

Command report_command() {
  const auto arguments = std::make_shared<ReportArguments>();
  return {.name = "report",
          .description = "Make a page of a run or of a set of runs, in one HTML file",
          .options = {{.name = "FOLDER",
                       .target = &arguments->folders,
                       .help = "Folder of a run, or of runs at any depth; several are compared"},
                      {.name = "--history",
                       .target = &arguments->history,
                       .help = "Folder with a folder of runs for each version, in the order of "
                               "their names: figures over versions, with an alarm where the "
                               "newest leaves the band of the earlier ones",
                       .type = "FOLDER"},
                      {.name = "--out",
                       .target = &arguments->out,
                       .help = "The page (default: report.html in the first folder)",
                       .type = "FILE"},
                      report_size_option(arguments->megabytes),
                      {.name = "--open",
                       .target = &arguments->open,
                       .help = "Open it in the browser (xdg-open)"}},
          .run = [arguments] { return report(*arguments); }};
}

}  // namespace vinebench::tools
