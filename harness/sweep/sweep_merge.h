// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/sets/run_set.h"
#include "harness/sweep/sweep_plan.h"

namespace vinebench::harness {

/// The results of a sweep, whatever shards they came from.
struct MergedSweep {
  std::vector<PlannedRun> plan;  ///< of all tasks, in the plan's order
  SetOutcome outcome;            ///< likewise; of each run the estimate's metrics and what failed
  std::vector<std::size_t> missing;  ///< tasks
};

/// Collects the results of all tasks, each from whichever of the folders has it. Throws one Error
/// that names all results (the first ten) that must not stand in one table: of other inputs than
/// the plan's, without a hash, of environments whose hashes are not comparable, or two of one run
/// that differ. Throws Error as planned_runs().
MergedSweep merge_sweep(const SweepPlan& plan, const std::vector<std::filesystem::path>& folders,
                        const ScenarioLoader& load);

/// A row for each run: its cell, seed and repeat, verdict, hash and the estimate's metrics in the
/// units of metrics.json. Depends on nothing but the results.
std::string format_csv(const SweepPlan& plan, const MergedSweep& merged);

/// What is missing, the first ten of it by name; empty if nothing is.
std::string format_missing(const MergedSweep& merged);

}  // namespace vinebench::harness
