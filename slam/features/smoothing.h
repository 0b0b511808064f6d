// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

namespace vinebench::slam {

/// A CV_8UC1 image under a Gaussian of sigma 2 px cut to 7 x 7 px, its edges mirrored about the
/// outermost pixels. Computed in integers, so the same on every machine; weights are rounded to
/// 1/128.
cv::Mat smooth(const cv::Mat& image);

}  // namespace vinebench::slam
