// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "harness/datasets/format/record_options.h"
#include "harness/experiment/scenario.h"
#include "harness/run.h"

namespace vinebench::harness {

/// Where grown plants are kept between runs: $VINEBENCH_CACHE, else $XDG_CACHE_HOME/vinebench, else
/// ~/.cache/vinebench, else a folder for temporary files.
std::filesystem::path default_cache();

/// A data set that a run leaves beside its results: its whole rig and all of its frames.
struct RunRecording {
  std::filesystem::path folder;
  RecordOptions options;
};

/// Prepares a folder for a scenario's run; it gets scenario.resolved.yaml. Throws Error as
/// prepare_run_folder().
void prepare_scenario_folder(const std::filesystem::path& folder, const ScenarioConfig& scenario);

/// Builds the simulation and the SLAM system of a scenario and runs one on the other, recording
/// where that is asked for. `threads` counts all threads that share the work; it changes no result.
RunOutcome run_scenario(const ScenarioConfig& scenario, int threads, const RunOptions& options,
                        const std::optional<RunRecording>& recording = std::nullopt);

}  // namespace vinebench::harness
