// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "core/config/override.h"
#include "core/files/output_folder.h"
#include "harness/datasets/open_recording.h"
#include "harness/run.h"
#include "harness/systems/slam_choice.h"

namespace vinebench::harness {

/// Settings of the SLAM core for a replay: those of `file`, else the recording's own, else the
/// defaults; then the overrides, "slam.KEY=VALUE". The file has the keys of a scenario's `slam`.
/// Throws Error that names file, line and key.
slam::SlamConfig replay_settings(const Recording& recording, const std::filesystem::path& file,
                                 const std::vector<Override>& overrides);

/// The same where another system may take the core's place (slam.external, slam.plugin). The
/// recording's own settings may name none: what is downloaded is not executed.
SlamChoice replay_choice(const Recording& recording, const std::filesystem::path& file,
                         const std::vector<Override>& overrides);

/// Prepares a folder for a replay, with slam.resolved.yaml. Throws Error as prepare_run_folder()
/// does.
[[nodiscard]] FolderLock prepare_replay_folder(const std::filesystem::path& folder,
                                               const SlamChoice& slam);

/// Runs the SLAM core on the recording's frames and evaluates it with the recording's ground truth,
/// if there is one; writes the same files as a scenario's run.
RunOutcome run_replay(Recording recording, const slam::SlamConfig& slam, int threads,
                      const RunOptions& options);

/// The same with whatever system is chosen; one that is not the core gets the frames as in a
/// scenario's run, a program as a recording without a truth. `plugin_host` is find_plugin_host(),
/// used by plug-ins alone. Throws Error as make_other_system() does, and for maps without the core.
RunOutcome run_replay(Recording recording, const SlamChoice& choice, int threads,
                      const RunOptions& options, const std::filesystem::path& plugin_host);

/// Human-readable metrics and faults of a replay, one line each.
std::string format_replay(const RunReport& report);

}  // namespace vinebench::harness
