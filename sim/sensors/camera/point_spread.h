// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

namespace vinebench::sim {

inline constexpr double kWidestPointSpread = 0.8;  ///< px

/// Spreads each point of an image as a lens in focus and the pixel's own area do: light by three
/// taps in rows and in columns with the variance sigma^2 (px^2), its rim repeated outwards. Of
/// light (CV_32FC3), or of codes (CV_8UC3), whose squares are taken for their light: with sigma =
/// 0.5 px that errs by 9 of 255 codes beside an edge between black and white. `sigma` from 0,
/// which changes nothing, to kWidestPointSpread.
void spread_points(cv::Mat& image, double sigma);

}  // namespace vinebench::sim
