// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/util/arithmetic.h"
#include "harness/judge/degraded_segments.h"
#include "harness/judge/findings/discrepancy.h"
#include "harness/judge/findings/error_pattern.h"
#include "harness/judge/verdict.h"
#include "harness/run/run_cost.h"

namespace vinebench::harness {

/// Means of one camera over a run's frames.
struct CameraReport {
  std::string name;
  double features = 0;
  double inliers = 0;
  Occlusion occlusion{};
};

/// A kind of fault in the source's data.
struct FaultCount {
  std::string kind;
  int count = 0;
};

/// All that is known of a run after it: what metrics.json is written from.
struct RunReport {
  std::string scenario;
  std::int64_t seed = 0;
  std::int64_t frames = 0;
  RunResults results;
  std::size_t keyframes = 0;
  std::size_t landmarks = 0;
  std::vector<CameraReport> cameras;     ///< of the rig, in its order
  std::vector<FaultCount> input_faults;  ///< in order of the first of each kind
  std::vector<DegradedSegment> diagnosis;
  std::vector<ErrorPattern> patterns;
  std::vector<Discrepancy> discrepancies;  ///< of the trial
  std::optional<SlamFailure> failure;      ///< of the system under test
  std::vector<Check> checks;  ///< of the scenario's expectations, and of no failure if there is one
  RunCost cost;               ///< filled by the run loop, as the hash
  std::string hash;  ///< of inputs, estimates and results; empty if the run was interrupted
  NamedValues hash_environment;  ///< of the hash (run/hash_environment.h)
};

/// All of the report that is a function of the record. Throws Error if an expectation names a
/// camera that the rig does not have.
RunReport judge(const RunRecord& record, const Trial& trial);

}  // namespace vinebench::harness
