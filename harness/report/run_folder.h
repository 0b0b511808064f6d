// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "core/files/output_folder.h"
#include "harness/judge/run_report.h"

namespace vinebench::harness {

/// In the folder of a set's run: the fingerprint of its inputs (run_inputs.h).
inline constexpr const char* kInputsFile = "inputs.txt";

/// The final map's landmarks, of a run with a film: PLY, in the map's axes.
inline constexpr const char* kLandmarksFile = "landmarks.ply";

/// Before the number of a folder of repeats: seed-1/repeat-2. The first is seed-1 itself.
inline constexpr const char* kRepeatFolder = "repeat-";

/// Creates the folder of a run, writes its settings to a file of the given name and removes results
/// of an earlier run that would remain (metrics.json and images of frames). The folder belongs to
/// this process while the lock lives. Throws Error if the folder is not writable or another process
/// has it, before any work is done.
[[nodiscard]] FolderLock prepare_run_folder(const std::filesystem::path& folder,
                                            const std::string& name, const std::string& settings);

/// Trajectories, events, plot and summary: all except the metrics, which only a complete run has.
void write_run_files(const std::filesystem::path& folder, const Trial& trial,
                     const RunRecord& record, const RunReport& report);

void write_metrics(const std::filesystem::path& folder, const RunReport& report);

}  // namespace vinebench::harness
