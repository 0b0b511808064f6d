// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "harness/report/metric_table.h"

namespace vinebench::harness {

/// Where a value of the newest version is expected if nothing has changed.
struct Band {
  double low = 0, high = 0;  ///< displayed unit
  bool contains(double value) const { return low <= value && value <= high; }
};

/// The two-sided 99 % prediction interval of Student's t for one more value, of logarithms for a
/// positive ratio. A standard deviation below 1 % of the mean, or below the metric's tolerance,
/// counts as that: figures of a deterministic system are equal to the digit until they change, and
/// then a smaller change is no alarm. Empty with fewer than three values.
std::optional<Band> band_of(const Metric& metric, const std::vector<double>& earlier);

/// Names in the order of their parts: digits by their value, so that "run-9" is before "run-10".
bool in_natural_order(const std::string& a, const std::string& b);

/// Every folder in `folder` is a set of runs of one version, in the natural order of their names,
/// the newest last. Of each scenario and metric the median over the seeds by version, null where a
/// version has none; the band of the earlier ones, and whether the newest has left it to the worse
/// or to the better. Throws Error for a folder without any run in its folders.
nlohmann::ordered_json history_json(const std::filesystem::path& folder);

}  // namespace vinebench::harness
