// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/reading/recording.h"

namespace vinebench::harness {

/// Whether a folder has mav0 or cam0.
bool is_euroc(const std::filesystem::path& folder);

/// Reads an EuRoC/ASL folder, including the extensions of our recordings. Throws Error for a
/// calibration that cannot be used and for lists that are not there or faulty.
Recording read_euroc(const std::filesystem::path& folder, const RecordingOptions& options);

}  // namespace vinebench::harness
