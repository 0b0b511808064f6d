// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/judge/metrics.h"

namespace vinebench::harness {

/// A figure of metrics.json that runs are put side by side by.
struct Metric {
  std::string key{};    ///< JSON pointer into metrics.json
  std::string title{};  ///< with the unit it is shown in
  double scale = 1;     ///< from the unit of metrics.json to the shown one
  int decimals = 0;     ///< shown
  bool larger_is_better = false;
  bool of_estimate = true;  ///< says how good the estimate is, not what it cost
};

/// In the order they are shown in.
const std::vector<Metric>& shown_metrics();

/// In the shown unit; nothing where the run could not measure it.
std::optional<double> value_of(const Metric& figure, const Json& metrics);

/// A cell of a table, "–" for nothing.
std::string format_value(const Metric& figure, const std::optional<double>& value);

/// Rows of cells as a Markdown table whose columns line up; the first row is the header. The first
/// `left` columns are aligned to the left, the others to the right.
std::string markdown_table(const std::vector<std::vector<std::string>>& rows, std::size_t left);

}  // namespace vinebench::harness
