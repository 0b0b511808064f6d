// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "core/slam_system.h"
#include "harness/datasets/format/recording_notes.h"
#include "harness/systems/slam_choice.h"

namespace vinebench::harness {

/// Throws Error, with the origin of the choice if it has one, if it executes a program or loads
/// code.
void expect_no_code(const SlamChoice& choice, const std::filesystem::path& origin);

/// What a system that is not the core needs of its run.
struct OtherSystemPlaces {
  std::filesystem::path plugin_host;  ///< find_plugin_host(); of PluginSlamConfig alone
  std::filesystem::path folder;       ///< of the run, of ExternalSlamConfig alone
  std::function<bool()> stopped;      ///< polled while the system works; may be empty
};

/// The program or plug-in of a choice that has one, on frames of this rig, the nominal one of the
/// notes. Throws Error as make_external_slam() and load_plugin_slam() do.
std::unique_ptr<SlamSystem> make_other_system(const SlamChoice& choice, const Rig& rig,
                                              const RecordingNotes& notes, int threads,
                                              const OtherSystemPlaces& places);

}  // namespace vinebench::harness
