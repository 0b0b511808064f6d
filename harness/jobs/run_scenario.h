// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/files/output_folder.h"
#include "harness/datasets/format/record_options.h"
#include "harness/experiment/scenario.h"
#include "harness/machine.h"
#include "harness/run.h"

namespace vinebench::harness {

/// A data set that a run writes beside its results: all frames, of the cameras that are named.
struct RunRecording {
  std::filesystem::path folder;
  RecordOptions options;
};

/// Prepares a folder for a scenario's run, with scenario.resolved.yaml. Throws Error as
/// prepare_run_folder() does.
[[nodiscard]] FolderLock prepare_scenario_folder(const std::filesystem::path& folder,
                                                 const ScenarioConfig& scenario);

/// Builds simulation and SLAM system of a scenario and runs them in lockstep, with recording if
/// requested; before that its earlier visit, whose results are in the folder's earlier-visit.
/// `threads` is the total number of worker threads; it changes no result.
RunOutcome run_scenario(const ScenarioConfig& scenario, const Machine& machine, int threads,
                        const RunOptions& options,
                        const std::optional<RunRecording>& recording = std::nullopt);

/// What a SLAM system is given before the first frame.
struct SystemSetup {
  const Rig& rig;  ///< nominal
  std::vector<RegisteredTag> tags;
  std::optional<slam::MecanumWheels> wheels;
  int threads = 1;
};
/// Makes the system under test. A SystemFailure in it is the run's verdict.
using SystemMaker = std::function<std::unique_ptr<SlamSystem>(const SystemSetup&)>;

/// As run_scenario(), with a system of the caller's in place of the scenario's, judged as other
/// systems are: without the guard, which was measured with the built-in core. Throws Error for a
/// scenario with an earlier visit, whose map only the built-in core keeps.
RunOutcome run_scenario_with(const SystemMaker& make, const ScenarioConfig& scenario,
                             const Machine& machine, int threads, const RunOptions& options);

}  // namespace vinebench::harness
