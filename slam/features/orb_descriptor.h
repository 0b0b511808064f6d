// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "slam/features/features.h"

namespace vinebench::slam {

/// How far from a keypoint its direction and its descriptor look, px of its level: so much of the
/// image must lie around it.
constexpr int kOrbReach = 17;

/// Direction of the intensity centroid of a disc 31 px across (Rosin 1999; Rublee et al. 2011),
/// rad from the x axis towards the y axis (down).
float centroid_angle(const cv::Mat& image, int x, int y);

/// 256 comparisons of two pixels each in a smoothed image, their places turned by `angle`
/// (rotated BRIEF, Rublee et al. 2011). Places are drawn once from a fixed seed, normally
/// distributed about the keypoint as in BRIEF (Calonder et al. 2010).
Descriptor rotated_brief(const cv::Mat& smoothed, int x, int y, float angle);

}  // namespace vinebench::slam
