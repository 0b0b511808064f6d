// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "harness/datasets/reading/recording.h"

namespace vinebench::harness {

/// Readings sorted by time, without duplicate stamps; events in the first frame say what was
/// wrong. `sensor` is for these.
template <class Reading>
void put_in_order(std::vector<Reading>& readings, const std::string& sensor, Recording& recording) {
  const bool ascending = std::ranges::is_sorted(readings, {}, &Reading::stamp);
  std::ranges::stable_sort(readings, {}, &Reading::stamp);
  const auto repeated =
      std::unique(readings.begin(), readings.end(),
                  [](const Reading& a, const Reading& b) { return a.stamp == b.stamp; });
  std::vector<SourceEvent>& events = recording.frames.front().events;
  if (!ascending) events.push_back({"stamp_out_of_order", sensor, "readings sorted"});
  if (repeated != readings.end()) {
    events.push_back(
        {"stamp_repeated", sensor, fmt::format("{} readings dropped", readings.end() - repeated)});
  }
  readings.erase(repeated, readings.end());
}

}  // namespace vinebench::harness
