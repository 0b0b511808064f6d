// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/commands/report/open_page.h"

#include <fmt/format.h>
#include <spawn.h>
#include <unistd.h>

#include <array>
#include <cstring>

#include "core/files/files.h"
#include "core/util/error.h"

namespace vinebench::tools {

void write_report(const std::filesystem::path& file, const harness::ReportRequest& request) {
  const std::string page = harness::report_page(request);
  write_file_atomically(file, page);
  fmt::print("report: {} ({:.1f} MB)\n", std::filesystem::absolute(file).string(),
             1e-6 * static_cast<double>(page.size()));
}

Option report_size_option(double& megabytes) {
  return {.name = "--report-size",
          .target = &megabytes,
          .help = "Most megabytes of the report; pictures fill what the figures leave",
          .show_default = true,
          .range = Range::between(1, 2000)};
}

void open_page(const std::filesystem::path& file) {
  std::string program = "xdg-open", page = std::filesystem::absolute(file).string();
  const std::array<char*, 3> arguments{program.data(), page.data(), nullptr};
  pid_t process = 0;
  const int error =
      posix_spawnp(&process, program.c_str(), nullptr, nullptr, arguments.data(), environ);
  if (error != 0) fail("--open: xdg-open: {}; the page is {}", std::strerror(error), page);
}

}  // namespace vinebench::tools
