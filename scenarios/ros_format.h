// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scenarios/dataset_format.h"

namespace vinebench {

/// A bag of ROS (1): for every camera /<camera>/image_rect (image_raw with distortion) and
/// camera_info, /imu, /odom (the true pose of base_link in world), /tf, /tf_static, /clock, and
/// /tag_<id>/pose of the tags that are wholly in view, in the camera that sees them. It is
/// run.bag.active until it is whole. Throws Error where the program was built without ROS's
/// libraries.
std::unique_ptr<DatasetFormat> make_ros_format(const std::filesystem::path& folder,
                                               const RecordingNotes& notes);

/// Whether the program was built with them.
bool can_write_ros();

}  // namespace vinebench
