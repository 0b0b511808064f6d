// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "harness/page/report_page.h"
#include "tools/arguments/command.h"

namespace vinebench::tools {

/// Name of a report in the folder that it is of.
inline constexpr const char* kReportFile = "report.html";

/// Writes the page and prints where it is. Throws Error as report_page() does, and where the file
/// cannot be written.
void write_report(const std::filesystem::path& file, const harness::ReportRequest& request);

/// `--report-size`, MB.
Option report_size_option(double& megabytes);

/// Opens a file in the user's browser, by xdg-open, without waiting for it. Throws Error where that
/// program cannot be started.
void open_page(const std::filesystem::path& file);

}  // namespace vinebench::tools
