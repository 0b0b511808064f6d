// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/format/recording_notes.h"
#include "harness/datasets/reading/recording.h"

namespace vinebench::harness {

// Our extensions of formats that a replay reads: what it needs to repeat a run bit by bit.

/// Stamps of all frames, because any camera may lack one.
inline constexpr const char* kFrameList = "frames.csv";
inline constexpr const char* kFrameListHeader = "#timestamp [ns]\n";

/// Writes rig.yaml, tags.yaml and slam.yaml.
void write_our_files(const std::filesystem::path& folder, const RecordingNotes& notes);

/// Throws Error with the line where stamps do not ascend, and if there are none.
std::vector<Stamp> read_frame_list(const std::filesystem::path& file);

/// Sets the tags from tags.yaml and the settings to slam.yaml, where these are there.
void read_tags_and_settings(const std::filesystem::path& folder, Recording& recording);

}  // namespace vinebench::harness
