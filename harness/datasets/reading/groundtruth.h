// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/reading/recording.h"

namespace vinebench::harness {

/// Ground truth of a recording whose frames and rig are known, from a file of any of the three
/// formats, detected from its columns:
///   TUM   `t[s] x y z qx qy qz qw`: T_world_body
///   EuRoC `t[ns],x,y,z,qw,qx,qy,qz,...`: T_world_body
///   KITTI 12 numbers a line, one line a frame: pose of the camera T_body_left against the first
///         one's axes (x right, y down, z ahead), which become x ahead, y left, z up here
/// A KITTI file whose length differs from the recording's adds an event to its last frame.
Trajectory read_groundtruth(const std::filesystem::path& file, Recording& recording);

/// Poses in the order of the file; `T_body_sensor` is the pose of the file's sensor on the body.
/// Throws Error that names file and line.
Trajectory read_euroc_poses(const std::filesystem::path& file, const Pose& T_body_sensor);

}  // namespace vinebench::harness
