// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

namespace vinebench::sim {

/// The engines' encoding of light (1 is white): code / 255 = light^(1 / 2.2).
inline constexpr double kImageGamma = 2.2;

/// Light, 0 to 1, of a code of 0 to 255, and back.
double light_of_code(double code, double gamma = kImageGamma);
double code_of_light(double light, double gamma = kImageGamma);

/// Images of codes (CV_8UC3) to linear light (CV_32FC3) and back, rounded and saturated. There
/// and back gives the same codes.
cv::Mat to_light(const cv::Mat& codes);
cv::Mat to_codes(const cv::Mat& light);

/// Adds the light of an image of codes, times `share`, to `sum` (begun with zeros where empty).
void add_light(const cv::Mat& codes, float share, cv::Mat& sum);

}  // namespace vinebench::sim
