// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "core/trajectory.h"

namespace vinebench::harness {

/// Reads the trajectory of another SLAM system for frames with these stamps (ascending). Columns
/// separated by blanks are `t x y z qx qy qz qw` (TUM), by commas `t,x,y,z,qw,qx,qy,qz` (EuRoC);
/// further ones are ignored. Times are in seconds, or in nanoseconds if they would otherwise lie
/// beyond the last frame. Each frame takes the nearest pose within 10 ms and half a frame period;
/// its T_map_body is the file's T_map_sensor times T_sensor_body. Empty for an empty file. Throws
/// Error with file and line for an invalid row, and if no pose matches a frame.
Trajectory read_foreign_trajectory(const std::filesystem::path& file,
                                   const std::vector<Stamp>& frames, const Pose& T_sensor_body);

}  // namespace vinebench::harness
