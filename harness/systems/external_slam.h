// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "harness/datasets/euroc/euroc_sink.h"
#include "harness/systems/slam_choice.h"

namespace vinebench::harness {

/// Throws Error if the rig has no camera of that name.
void check_external_slam(const ExternalSlamConfig& config, const Rig& rig);

/// A program as a SLAM system: frames are recorded under FOLDER/recording (an EuRoC/ASL folder, as
/// EurocSink writes it, without a ground truth); in the end the program runs in FOLDER/external,
/// and what it leaves there is the summary's trajectory; estimates have no pose.
/// VINEBENCH_RECORDING and VINEBENCH_OUTPUT name both folders to it. Throws Error for a program
/// that cannot be executed and for a trajectory outside of its folder, before anything is recorded;
/// finish() throws SystemFailure for a program that fails or exceeds a limit, leaves no trajectory
/// or one that cannot be read; its messages are in FOLDER/external/log.txt. When it is stopped
/// there is no trajectory.
std::unique_ptr<SlamSystem> make_external_slam(const ExternalSlamConfig& config,
                                               const RecordingNotes& notes,
                                               const std::filesystem::path& folder,
                                               std::function<bool()> stopped);

}  // namespace vinebench::harness
