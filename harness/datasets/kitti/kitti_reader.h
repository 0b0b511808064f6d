// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/reading/recording.h"

namespace vinebench::harness {

/// Whether a folder has calib.txt or the images of a pair.
bool is_kitti(const std::filesystem::path& folder);

/// Reads a KITTI odometry folder, including the extensions of our recordings. Throws Error for a
/// calibration that cannot be used, folders without images and lists of another length.
Recording read_kitti(const std::filesystem::path& folder, const RecordingOptions& options);

}  // namespace vinebench::harness
