// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "core/trajectory.h"

namespace vinebench::harness {

/// Reads the trajectory of somebody else's SLAM system on frames with these stamps (ascending).
/// Columns between blanks are `t x y z qx qy qz qw` (TUM), between commas `t,x,y,z,qw,qx,qy,qz`
/// (EuRoC); further ones are left out. Times are seconds, or nanoseconds where they would otherwise
/// lie beyond the last frame. Each frame takes the nearest pose within 10 ms and half a frame; its
/// T_map_body is the written T_map_sensor times T_sensor_body. Nothing is there of an empty file.
/// Throws Error with file and line for a row that is no pose, and when no pose is of any frame.
Trajectory read_foreign_trajectory(const std::filesystem::path& file,
                                   const std::vector<Stamp>& frames, const Pose& T_sensor_body);

}  // namespace vinebench::harness
