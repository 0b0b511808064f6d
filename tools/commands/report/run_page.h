// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/run.h"
#include "harness/view/live_view.h"
#include "tools/arguments/command.h"

namespace vinebench::tools {

/// What of a run is shown in a browser: a report after it, a view while it goes on.
struct PageArguments {
  bool report = false;
  double megabytes = 20;  ///< of the report
  std::optional<std::int64_t> view;
  std::string view_host = "127.0.0.1";

  /// Whether the run keeps what a report needs; a view ends with one.
  bool keeps() const { return report || view; }
  std::size_t bytes() const { return static_cast<std::size_t>(1e6 * megabytes); }
};

/// --report, --report-size.
std::vector<Option> report_options(PageArguments& arguments);
/// --view, --view-host.
std::vector<Option> view_options(PageArguments& arguments);

/// The pages of one run.
class RunPage {
 public:
  /// Serves the view, if one is asked for, and prints its address. Throws Error as LiveView.
  RunPage(const PageArguments& arguments, const std::function<bool()>& stopped);

  /// The view watches the run.
  void join(harness::RunOptions& options);
  /// Writes the report of the run, if there is to be one, and ends the view.
  void finish(const std::filesystem::path& folder, const std::string& verdict);

 private:
  PageArguments arguments_;
  std::optional<harness::LiveView> view_;
};

}  // namespace vinebench::tools
