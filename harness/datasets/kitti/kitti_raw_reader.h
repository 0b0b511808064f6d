// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/reading/recording.h"

namespace vinebench::harness {

/// Whether a folder is a drive of KITTI's raw data: image_00/data or image_02/data.
bool is_kitti_raw(const std::filesystem::path& folder);

/// Reads a drive, rectified (sync) or not (extract), with the calibration of its day in the folder
/// above or its own. The body is the inertial unit where the calibration has it, else camera 0 with
/// x ahead, y left, z up. Throws Error for a calibration that cannot be used, folders without
/// images and lists that are too short.
Recording read_kitti_raw(const std::filesystem::path& folder, const RecordingOptions& options);

}  // namespace vinebench::harness
