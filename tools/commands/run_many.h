// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/files/output_folder.h"
#include "harness/experiment/scenario.h"
#include "harness/machine.h"
#include "harness/sets/run_set.h"

namespace vinebench::tools {

/// `run` with several scenarios or seeds.
struct ManyRuns {
  std::vector<harness::ScenarioConfig> scenarios;
  harness::Machine machine;
  std::vector<std::int64_t> seeds;  ///< each scenario's own if empty
  std::filesystem::path out;
  std::filesystem::path junit;  ///< none if empty
  int jobs = 1;
  int threads = 1;
  int repeats = 1;
  bool force = false;
  bool report = false;           ///< keep small pictures, and make a page
  std::size_t report_bytes = 0;  ///< most of the page
};

/// How runs are made.
struct RunsAtOnce {
  harness::Machine machine;
  int jobs = 1;     ///< parallel runs
  int threads = 1;  ///< of all jobs together
  bool force = false;
  bool film = false;  ///< keep small pictures
};

/// Makes those of the runs that are missing, until they are there or ^C comes.
harness::SetOutcome make_planned_runs(const std::vector<harness::PlannedRun>& plan,
                                      const RunsAtOnce& how);

/// The runs of a set, in the folder that the lock is of.
struct MadeRuns {
  FolderLock lock;
  std::vector<harness::PlannedRun> plan;
  harness::SetOutcome outcome;
};

/// Makes the runs that are missing, and says so if it is interrupted.
MadeRuns make_runs(const ManyRuns& many);

/// Runs them, prints and writes the table, and returns the exit code.
int run_many(const ManyRuns& many);

}  // namespace vinebench::tools
