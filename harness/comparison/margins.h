// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/report/metric_table.h"

namespace vinebench::harness {

/// Which difference of a metric matters.
struct Margin {
  /// Of a ratio: 0.1 is B between A / 1.1 and A * 1.1. Of an ordered metric: of the seeds, in which
  /// B may have more, or less, than A.
  double share = 0.10;
  /// In the displayed unit. A ratio is then compared by its differences, by at most this on
  /// average. Ordered values that are at most this far apart are the same.
  std::optional<double> absolute{};
};

/// One for all metrics, and those of single metrics.
struct Margins {
  Margin common{};
  std::map<std::string, Margin> own{};  ///< by the metric's key

  Margin of(const Metric& metric) const;
};

/// Each text is "5%" (all metrics), "METRIC=5%" or "METRIC=2". Throws Error that names the option,
/// for an unknown metric and for a value out of range.
Margins parse_margins(const std::vector<std::string>& texts, const std::string& option);

/// The metrics of these names, those that comparisons show if there are none. Throws Error for an
/// unknown name and one that is repeated.
std::vector<Metric> parse_metrics(const std::vector<std::string>& names);

}  // namespace vinebench::harness
