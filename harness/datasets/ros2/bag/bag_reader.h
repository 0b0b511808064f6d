// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/reading/recording.h"

namespace vinebench::harness {

/// Reads a bag of ROS 2 or 1: an MCAP, SQLite or .bag file, or a folder with such files, including
/// the extensions of our recordings. docs/replay.md has the topics. Throws Error for a file that is
/// broken before its end, a calibration that cannot be used, and a bag without a stereo pair.
Recording read_bag(const std::filesystem::path& bag, const RecordingOptions& options);

}  // namespace vinebench::harness
