// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/reading/recording.h"

namespace vinebench::harness {

/// Reads the index of a recording, whose format is detected from its folders and files: that of any
/// format with a reader, or a data set of ours that has one of them. Faults of single frames become
/// events; an unusable calibration, a folder without images and images of another size than the
/// calibration's throw Error.
Recording open_recording(const std::filesystem::path& folder, const RecordingOptions& options = {});

}  // namespace vinebench::harness
