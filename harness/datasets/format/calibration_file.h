// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/geometry/rig.h"

namespace vinebench::harness {

/// The true cameras, consistent with the labels: `cameras`, a list of name, size, intrinsics,
/// position (m) and rotation (qx qy qz qw) in the body, and `stereo_pairs` as in a rig. Reading
/// restores the same bits.
std::string format_calibration(const Rig& rig);

/// Throws Error that names file, line and key.
Rig read_calibration(const std::filesystem::path& file);

}  // namespace vinebench::harness
