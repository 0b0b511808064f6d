// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "harness/comparison/paired_runs.h"

namespace vinebench::harness {

/// What the hashes of several runs tell of each other.
enum class HashRelation {
  kSame,           ///< the runs are the same to the byte
  kDiffer,         ///< also if only some do
  kUnknown,        ///< a run has no hash
  kNotComparable,  ///< all have one, of environments that may compute other bytes
};

struct HashComparison {
  HashRelation relation = HashRelation::kSame;
  /// Of kNotComparable: "their environments differ in blas, libm", or that one is not known.
  std::string reason{};
};

HashComparison compare_hashes(const std::vector<StoredRun>& runs);

/// Of the runs of each pair: not comparable if one pair is not, else unknown, then different, if
/// one pair is.
HashComparison compare_hashes(const std::vector<RunPair>& pairs);

}  // namespace vinebench::harness
