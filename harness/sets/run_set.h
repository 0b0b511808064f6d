// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "harness/experiment/scenario.h"
#include "harness/run.h"

namespace vinebench::harness {

/// One run of a set of scenarios and seeds.
struct PlannedRun {
  ScenarioConfig scenario;       ///< with the run's seed
  std::filesystem::path folder;  ///< for its results
};

/// The runs of each scenario over the seeds, each scenario's own seed where there are none, in
/// OUT/<scenario>/seed-<n>. Throws Error when two scenarios have one name.
std::vector<PlannedRun> plan_set(const std::vector<ScenarioConfig>& scenarios,
                                 const std::vector<std::int64_t>& seeds,
                                 const std::filesystem::path& out);

/// Runs one scenario with so many threads.
using RunFunction =
    std::function<RunOutcome(const ScenarioConfig&, int threads, const RunOptions&)>;

struct SetOptions {
  int jobs = 1;                      ///< runs side by side
  int threads = 1;                   ///< of all jobs together; each has one at least
  bool force = false;                ///< also what is there already
  RunFunction run;                   ///< called in processes of their own
  std::function<bool()> stopped;     ///< asked all the time; may be empty
  std::ostream* progress = nullptr;  ///< told of every run that is over
};

/// What became of a planned run.
struct SetRun {
  std::string scenario;
  std::int64_t seed = 0;
  std::filesystem::path folder;
  bool kept = false;    ///< its results were there already
  std::string error{};  ///< why there are no results; empty where there are
  Json metrics{};       ///< null where there are no results
  std::vector<Check> checks{};

  bool failed() const { return error.empty() && !all_hold(checks); }
};

/// The runs in the order they were planned.
struct SetOutcome {
  bool interrupted = false;
  std::vector<SetRun> runs;
};

/// Runs them side by side, each in a process of its own whose messages go to log.txt in its folder,
/// so that one that crashes or fails takes no other along. A run that is there already, whole and
/// of the same inputs, is kept. Threads change no result.
SetOutcome run_set(const std::vector<PlannedRun>& plan, const SetOptions& options);

}  // namespace vinebench::harness
