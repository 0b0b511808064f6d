// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/report/metric_table.h"

namespace vinebench::harness {

/// The runs of one scenario and seed: a single one, or repeats in their order.
struct SeedRuns {
  std::string scenario{};
  std::int64_t seed = 0;
  std::vector<StoredRun> repeats{};
  std::filesystem::path folder{};  ///< of the first
};

/// A metric's mean over the repeats that have it, in its displayed unit: the geometric mean of a
/// ratio's values if all are positive, else the arithmetic one. Of a run whose SLAM system failed
/// there is only whether it passed, because its other metrics are of fewer frames.
std::optional<double> value_of(const Metric& metric, const SeedRuns& runs);

/// Every run in a folder, at any depth, by scenario and seed. Runs of one scenario and seed are
/// repeats if they lie in FOLDER, FOLDER/repeat-2, FOLDER/repeat-3 and so on. Throws Error if there
/// is no run, a duplicate run or an unreadable metrics.json.
std::vector<SeedRuns> find_runs(const std::filesystem::path& folder);

/// Runs of one scenario and seed; as many repeats on both sides.
struct RunPair {
  SeedRuns before;
  SeedRuns after;
};

/// Runs of two folders, paired by scenario and seed, in their order.
struct PairedRuns {
  std::vector<RunPair> pairs;
  /// Runs that are in only one of the folders, or of another length, human-readable.
  std::vector<std::string> unpaired;
  /// Pairs whose experiments differ beside the SLAM system's settings, human-readable.
  std::vector<std::string> differing;
};

/// Each folder is a run's folder or contains runs' folders at any depth. Runs of different numbers
/// of frames are no pair, unless the SLAM system failed in one. Throws Error as find_runs does, for
/// an unreadable scenario.resolved.yaml, and if there is no pair.
PairedRuns pair_runs(const std::filesystem::path& before, const std::filesystem::path& after);

/// Pairs by scenario, as "row"; then all together if there are several, as "all scenarios".
std::vector<std::pair<std::string, std::vector<RunPair>>> groups_of(const PairedRuns& runs);

}  // namespace vinebench::harness
