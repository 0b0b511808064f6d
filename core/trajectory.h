// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "core/geometry/pose.h"
#include "core/time.h"

namespace vinebench {

struct StampedPose {
  Stamp stamp = 0;
  Pose pose;
};

/// Poses in ascending order of their stamps.
using Trajectory = std::vector<StampedPose>;

/// Reads a TUM file: `t[s] x y z qx qy qz qw` on each line; '#' begins a comment line. Throws Error
/// with file and line for a wrong number of columns, an invalid number, a quaternion that is not of
/// unit length, or stamps that do not ascend.
Trajectory read_tum(const std::filesystem::path& file);

/// The text of a TUM file: stamps with nine decimals, the rest to 1e-9.
std::string format_tum(const Trajectory& trajectory);

/// Writes a TUM file atomically.
void write_tum(const Trajectory& trajectory, const std::filesystem::path& file);

}  // namespace vinebench
