// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "core/geometry/camera.h"
#include "core/geometry/pose.h"

namespace vinebench {

/// The rover's pixels go where it goes, with their points on it: sets `motion` (as
/// RenderedImage::motion; made, with zeros, where it is empty) at the pixels that `labels` call the
/// rover's, from its place in this view to its other one. The camera is an ideal pinhole.
void move_rover(const PinholeCamera& camera, const Pose& T_world_cam, const Pose& T_world_rover,
                const Pose& T_world_rover_other, const cv::Mat& labels, const cv::Mat& depth,
                cv::Mat& motion);

}  // namespace vinebench
