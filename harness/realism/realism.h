// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/realism/picture_set.h"

namespace vinebench::harness {

/// One statistic of both sets.
struct StatisticComparison {
  std::string name;
  double low = 0;     ///< of the real pictures: 10th percentile
  double middle = 0;  ///< median
  double high = 0;    ///< 90th percentile
  double ours = 0;    ///< median of ours
  double share = 0;   ///< of the real values that are below it

  bool inside() const { return low <= ours && ours <= high; }
};

/// How far a set of ours resembles a real one.
struct Realism {
  std::string real;
  std::string ours;
  std::vector<StatisticComparison> statistics;  ///< those that both sets have
  /// Area under the ROC curve of a classifier that is to tell them apart, on pictures that it was
  /// not fitted to: 0.5 if it cannot, 1 if it always can (separability.h).
  std::optional<double> separability;

  int inside() const;
};

/// Throws Error if the sets' widths differ.
Realism compare_pictures(const PictureSet& real, const PictureSet& ours);

/// A table, the worst statistics first.
std::string format_realism(const Realism& realism);
nlohmann::ordered_json to_json(const Realism& realism);

}  // namespace vinebench::harness
