// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "core/geometry/camera.h"
#include "core/geometry/pose.h"

namespace vinebench {

/// Motion of the rover's pixels: sets `motion` (as RenderedImage::motion; created with zeros if
/// empty) at the pixels labelled as rover in `labels`, from the rover's pose in this view to that
/// in the other one. The camera is an ideal pinhole.
void move_rover(const PinholeCamera& camera, const Pose& T_world_cam, const Pose& T_world_rover,
                const Pose& T_world_rover_other, const cv::Mat& labels, const cv::Mat& depth,
                cv::Mat& motion);

}  // namespace vinebench
