// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "harness/comparison/compare.h"

namespace vinebench::test {

/// A run of the scenario "row" with these numbers of metrics.json.
inline harness::SeedRuns seed_runs(std::int64_t seed, const std::map<std::string, double>& values) {
  const harness::StoredRun run{.scenario = "row", .seed = seed, .values = values};
  return {.scenario = "row", .seed = seed, .repeats = {run}};
}

/// Pairs of one metric, seed by seed.
inline std::vector<harness::RunPair> run_pairs(const std::string& key,
                                               const std::vector<double>& before,
                                               const std::vector<double>& after) {
  std::vector<harness::RunPair> pairs;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const auto seed = static_cast<std::int64_t>(i);
    pairs.push_back({seed_runs(seed, {{key, before[i]}}), seed_runs(seed, {{key, after[i]}})});
  }
  return pairs;
}

/// What metrics.json has of a hash; `libm` computed it.
inline harness::Json hash_json(const std::string& hash, const std::string& libm = "vinebench") {
  return {{"hash", hash}, {"hash_environment", {{"libm", libm}, {"blas", "libblas.so"}}}};
}

}  // namespace vinebench::test
