// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/commands/report/run_page.h"

#include <fmt/format.h>

#include "tools/commands/report/open_page.h"

namespace vinebench::tools {

std::vector<Option> report_options(PageArguments& arguments) {
  return {{.name = "--report",
           .target = &arguments.report,
           .help = "Keep small pictures of every camera, and make a page of the run or the set: "
                   "report.html in the folder of the results"},
          report_size_option(arguments.megabytes)};
}

std::vector<Option> view_options(PageArguments& arguments) {
  return {{.name = "--view",
           .target = &arguments.view,
           .help = "Show the run in a browser while it goes on: prints the page's address, on this "
                   "machine; without PORT on any that is free. In the end it becomes the --report",
           .type = "[PORT]",
           .range = Range::between(0, 65535),
           .if_bare = "0"},
          {.name = "--view-host",
           .target = &arguments.view_host,
           .help = "Address of this machine at which others may see the view, who know the page's "
                   "address",
           .type = "ADDRESS",
           .show_default = true}};
}

RunPage::RunPage(const PageArguments& arguments, const std::function<bool()>& stopped)
    : arguments_(arguments) {
  if (!arguments.view) return;
  view_.emplace(harness::ViewAddress{arguments.view_host, static_cast<int>(*arguments.view)},
                stopped);
  fmt::print("view: {}\n", view_->address());
  std::fflush(stdout);
}

void RunPage::join(harness::RunOptions& options) {
  options.film = arguments_.keeps();
  if (view_) options.watcher = &*view_;
}

void RunPage::finish(const std::filesystem::path& folder, const std::string& verdict) {
  if (arguments_.keeps()) {
    write_report(folder / kReportFile, {{folder}, {}, arguments_.bytes()});
    std::fflush(stdout);
  }
  if (view_) view_->end(verdict, folder / kReportFile);
}

}  // namespace vinebench::tools
