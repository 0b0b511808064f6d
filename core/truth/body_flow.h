// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "core/geometry/camera.h"
#include "core/geometry/pose.h"

namespace vinebench {

/// Motion of the pixels of something rigid: sets `motion` (as RenderedImage::motion; created with
/// zeros if empty, unless nothing is masked) where `mask` (CV_8UC1) is not 0, from its pose in this
/// view to that in the other one. The camera is an ideal pinhole.
void move_body(const PinholeCamera& camera, const Pose& T_world_cam, const Pose& T_world_body,
               const Pose& T_world_body_other, const cv::Mat& mask, const cv::Mat& depth,
               cv::Mat& motion);

/// The same for the rover, at the pixels labelled as such.
void move_rover(const PinholeCamera& camera, const Pose& T_world_cam, const Pose& T_world_rover,
                const Pose& T_world_rover_other, const cv::Mat& labels, const cv::Mat& depth,
                cv::Mat& motion);

}  // namespace vinebench
