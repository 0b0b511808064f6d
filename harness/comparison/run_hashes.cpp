// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/comparison/run_hashes.h"

#include <algorithm>

#include "harness/run/hash_environment.h"

namespace vinebench::harness {
namespace {

/// Why hashes of two environments are not comparable; empty if they are.
std::string obstacle(const NamedValues& a, const NamedValues& b) {
  if (a.empty() || b.empty()) return "a metrics.json has no hash_environment";
  const std::string names = environment_differences(a, b);
  return names.empty() ? "" : "their environments differ in " + names;
}

}  // namespace

HashComparison compare_hashes(const std::vector<StoredRun>& runs) {
  const auto has_no_hash = [](const StoredRun& run) { return run.hash().empty(); };
  if (std::ranges::any_of(runs, has_no_hash)) return {HashRelation::kUnknown};
  HashComparison found;
  for (std::size_t i = 1; i < runs.size(); ++i) {
    std::string reason = obstacle(runs[0].hash_environment(), runs[i].hash_environment());
    if (!reason.empty()) return {HashRelation::kNotComparable, std::move(reason)};
    if (runs[i].hash() != runs[0].hash()) found.relation = HashRelation::kDiffer;
  }
  return found;
}

HashComparison compare_hashes(const std::vector<RunPair>& pairs) {
  HashComparison found;
  for (const RunPair& pair : pairs) {
    std::vector<StoredRun> runs = pair.before.repeats;
    runs.insert(runs.end(), pair.after.repeats.begin(), pair.after.repeats.end());
    HashComparison own = compare_hashes(runs);
    if (own.relation == HashRelation::kNotComparable) return own;
    if (own.relation == HashRelation::kUnknown || found.relation == HashRelation::kSame) {
      found = std::move(own);
    }
  }
  return found;
}

}  // namespace vinebench::harness
