// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "harness/experiment/scenario.h"
#include "harness/sets/run_set.h"
#include "harness/sweep/sweep_spec.h"

namespace vinebench::harness {

/// One run of a sweep.
struct SweepTask {
  std::size_t cell = 0;  ///< index into SweepPlan::cells
  std::int64_t seed = 1;
  int repeat = 1;
  std::string key;     ///< fingerprint of its inputs (run_inputs.h)
  double cost = 0;     ///< s of one core, estimated
  std::string folder;  ///< for its results, relative; no path, of which 10,000 take 10 MB
};

/// Which build the program is.
struct Build {
  std::string version;
  std::string program;  ///< hash of the executable
  bool operator==(const Build&) const = default;
};
Build this_build();

/// All runs of a sweep. A build makes a plan for itself alone: another one may have other results.
struct SweepPlan {
  Build build;
  int repeats = 1;
  std::vector<SweepCell> cells;
  std::vector<SweepTask> tasks;  ///< by cell, seed and repeat
};

/// Reads a scenario as the specification names it, with its overrides.
using ScenarioLoader =
    std::function<ScenarioConfig(const std::string& scenario, const std::vector<Override>&)>;

/// What a run of a scenario takes, s of one core.
using CostEstimate = std::function<double(const ScenarioConfig&)>;

/// Throws Error if a scenario cannot be read, or two have the same name.
SweepPlan make_plan(const SweepSpec& spec, const ScenarioLoader& load, const CostEstimate& cost);

/// As JSON lines: one about the plan, then one for each task.
std::string format_plan(const SweepPlan& plan);

/// Throws Error, with the line, for a file that is no plan, one of another format, or a part of
/// one.
SweepPlan read_plan(const std::filesystem::path& file);

/// Those of the tasks as runs of a set, with results below `out`. Throws Error if the plan is of
/// another build, or a scenario is not what it was when the plan was made.
std::vector<PlannedRun> planned_runs(const SweepPlan& plan, const std::vector<std::size_t>& tasks,
                                     const ScenarioLoader& load, const std::filesystem::path& out);

}  // namespace vinebench::harness
