// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "core/util/arithmetic.h"
#include "harness/report/report_json.h"

namespace vinebench::harness {

/// Among the values: 1 if all expectations are met, 0 if not; none for a run without expectations.
inline constexpr const char* kPassedKey = "/passed";

/// What the metrics.json of a run says: one of an earlier program, or of another process.
struct StoredRun {
  std::string scenario{};
  std::int64_t seed = 0;
  std::map<std::string, double> values{};  ///< every number by its JSON pointer, and kPassedKey
  std::vector<Check> checks{};
  Json json{};  ///< the file

  /// Empty if the run did not measure it.
  std::optional<double> value(const std::string& pointer) const;

  /// Of all its images and results; empty if the file has none.
  std::string hash() const;

  /// What the hash depends on beside scenario, seed and build (harness/run/hash_environment.h);
  /// empty if the file has none.
  NamedValues hash_environment() const;
};

/// Empty if this is not the metrics of a run.
std::optional<StoredRun> stored_run(Json metrics);

/// Empty if the file does not exist or is not the metrics.json of a run. Throws Error if it cannot
/// be read.
std::optional<StoredRun> read_stored_run(const std::filesystem::path& file);

}  // namespace vinebench::harness
