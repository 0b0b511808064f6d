// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace vinebench::sim {

/// Ranges of an image's rows, as the clip space's y, outside of which all rays point so far down
/// that the sky's image has one colour. `ray_from_clip` takes (x, y, 1, 0) to a ray in the world.
std::vector<Eigen::Vector2f> rows_with_sky(const Eigen::Matrix4f& ray_from_clip);

/// That colour, 0 to 1; alpha is 0, the label of the sky.
Eigen::Vector4f below_horizon(const cv::Mat& sky_image);

}  // namespace vinebench::sim
