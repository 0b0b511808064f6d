// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace vinebench::harness {

/// What a report shows.
struct ReportRequest {
  /// Each a run's folder, or one that contains runs' folders at any depth. Several are compared.
  std::vector<std::filesystem::path> folders;
  std::filesystem::path history{};  ///< of versions (history.h); none if empty
  std::size_t budget = 20'000'000;  ///< bytes of the page
};

/// One HTML page that needs no other file and no network. Runs' details, packed, and then their
/// pictures fill the budget: those of failed runs first. Throws Error for folders without runs and
/// for damaged files, which it names, and where the runs' figures alone exceed the budget.
std::string report_page(const ReportRequest& request);

}  // namespace vinebench::harness
