// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/files/output_folder.h"
#include "harness/datasets/format/record_options.h"
#include "harness/experiment/scenario.h"
#include "harness/machine.h"
#include "harness/run.h"

namespace vinebench::harness {

/// A data set that a run writes beside its results: all cameras and all frames.
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

}  // namespace vinebench::harness
