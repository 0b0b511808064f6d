// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "core/geometry/camera.h"
#include "sim/scene/scene.h"

namespace vinebench::sim {

/// Light that a sun in the image scatters inside the lens: a saturated disc, a bloom around it
/// and a veil over everything, by the share of the disc that no leaf covers. `rgb` CV_8UC3 and
/// `labels` CV_8UC1 of one image; `towards_sun` in the camera's frame. Nothing happens where the
/// sun is not in the image.
void add_glare(cv::Mat& rgb, const cv::Mat& labels, const PinholeCamera& camera,
               const Eigen::Vector3d& towards_sun, const Light& light, double exposure);

}  // namespace vinebench::sim
