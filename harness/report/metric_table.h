// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/report/stored_run.h"

namespace vinebench::harness {

/// How two runs are compared by a metric.
enum class Scale {
  kRatio,    ///< positive; worlds multiply it: B is so many times A
  kOrdered,  ///< a count or a share, with many equal values: B has more, less or the same
};

/// A metric of metrics.json for the comparison of runs.
struct Metric {
  std::string key{};    ///< JSON pointer into metrics.json
  std::string title{};  ///< with the displayed unit
  double scale = 1;     ///< from the unit of metrics.json to the displayed one
  int decimals = 0;     ///< shown
  bool larger_is_better = false;
  bool of_estimate = true;  ///< measures the estimate, not its run time
  Scale compared_by = Scale::kRatio;
  double tolerance = 0;  ///< displayed unit; ordered values at most this far apart are the same
};

/// In display order.
const std::vector<Metric>& shown_metrics();

/// The verdict "passed", the shown metrics, then those that only commands look up by name.
const std::vector<Metric>& known_metrics();

/// As on the command line: "ate_rmse_m", "loop_closures.wrong".
std::string name_of(const Metric& metric);

/// By name. Throws Error, with the nearest name, if there is none.
const Metric& metric_named(const std::string& name);

/// In the displayed unit; empty if the run did not measure it.
std::optional<double> value_of(const Metric& metric, const StoredRun& run);

/// A cell of a table, "–" if empty.
std::string format_value(const Metric& metric, const std::optional<double>& value);

/// Rows of cells as a Markdown table with aligned columns; the first row is the header. The first
/// `left` columns are aligned to the left, the others to the right.
std::string markdown_table(const std::vector<std::vector<std::string>>& rows, std::size_t left);

}  // namespace vinebench::harness
