// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "harness/datasets/euroc/euroc_writer.h"
#include "harness/systems/slam_choice.h"

namespace vinebench::harness {

/// Throws Error if the rig has no camera of that name.
void check_external_slam(const ExternalSlamConfig& config, const Rig& rig);

/// A program as a SLAM system: frames are recorded under FOLDER/recording (an EuRoC/ASL folder, as
/// EurocWriter writes it, without ground truth); after the last frame the program runs in
/// FOLDER/external, and the file that it writes there is the summary's trajectory; estimates have
/// no pose. The environment variables VINEBENCH_RECORDING and VINEBENCH_OUTPUT name both folders.
/// Throws Error if the program fails or its trajectory is missing or unreadable; its messages are
/// in FOLDER/external/log.txt. If it is stopped there is no trajectory.
std::unique_ptr<SlamSystem> make_external_slam(const ExternalSlamConfig& config,
                                               const RecordingNotes& notes,
                                               const std::filesystem::path& folder,
                                               std::function<bool()> stopped);

}  // namespace vinebench::harness
