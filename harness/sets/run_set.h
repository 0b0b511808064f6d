// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "harness/experiment/scenario.h"
#include "harness/report/stored_run.h"
#include "harness/run.h"

namespace vinebench::harness {

/// One run of a set of scenarios and seeds.
struct PlannedRun {
  std::shared_ptr<const ScenarioConfig> settings;  ///< shared by its seeds
  std::int64_t seed = 1;                           ///< in place of the settings'
  std::filesystem::path folder;                    ///< for its results
  std::string title;                               ///< of the settings, in tables
  int repeat = 1;                                  ///< of this seed
  int repeats = 1;                                 ///< planned of each seed

  /// The settings with the run's seed.
  ScenarioConfig scenario() const;
};

/// The runs of each scenario over the seeds (its own seed if there are none), in
/// OUT/<scenario>/seed-<n>; of several repeats the first is there, the others in repeat-<r> below,
/// so that a set can be given more repeats later. Throws Error if two scenarios have the same name.
std::vector<PlannedRun> plan_set(const std::vector<ScenarioConfig>& scenarios,
                                 const std::vector<std::int64_t>& seeds,
                                 const std::filesystem::path& out, int repeats = 1);

/// Runs one scenario with the given number of threads.
using RunFunction =
    std::function<RunOutcome(const ScenarioConfig&, int threads, const RunOptions&)>;

struct SetOptions {
  int jobs = 1;        ///< parallel runs
  int threads = 1;     ///< of all jobs together; each has at least one
  bool force = false;  ///< repeat existing runs
  RunFunction run;     ///< called in child processes
  /// What makes the frames of a scenario's run, as its RunOptions::libraries; called in child
  /// processes; nothing if empty.
  std::function<NamedValues(const ScenarioConfig&)> libraries;
  std::function<bool()> stopped;     ///< polled; may be empty
  std::ostream* progress = nullptr;  ///< gets a line for every finished run
};

/// The outcome of a planned run.
struct SetRun {
  std::string scenario;  ///< the title of its settings
  std::int64_t seed = 0;
  std::filesystem::path folder;
  int repeat = 1;
  int repeats = 1;       ///< planned of this seed
  bool kept = false;     ///< its results already existed
  bool missing = false;  ///< of a sweep: was not run yet
  std::string error{};   ///< why there are no results; empty if there are
  std::optional<StoredRun> result{};

  bool failed() const { return result && !all_hold(result->checks); }
  bool passed() const { return error.empty() && !missing && !failed(); }
};

/// "seed 3", of several repeats "seed 3, repeat 2".
std::string seed_text(std::int64_t seed, int repeat, int repeats);

/// The runs in planned order.
struct SetOutcome {
  bool interrupted = false;
  std::vector<SetRun> runs;
};

/// Runs them in parallel, each in its own process with its messages in log.txt of its folder, so
/// that a crash does not affect other runs. An existing complete run with the same inputs, of an
/// environment whose hashes are comparable, is kept, also one whose SLAM system failed. Metrics of
/// further repeats of a planned seed, which an earlier set has left with others, are removed.
/// Throws Error if `libraries` does. The number of threads changes no result.
SetOutcome run_set(const std::vector<PlannedRun>& plan, const SetOptions& options);

}  // namespace vinebench::harness
