// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>

#include "core/config/config_field.h"

namespace vinebench::sim {

/// A lens with an aperture, focused at one distance: what is nearer or further is blurred.
struct DepthOfFieldConfig {
  double aperture = 0;  ///< m, diameter of the entrance pupil; 0: everything is in focus
  double focus = 1;     ///< m along the optical axis to what is in focus
  template <class Archive>
  void serialize(Archive& archive) {
    archive("aperture", aperture, Range::between(0, 0.05));
    archive("focus", focus, Range::between(0.1, 1000));
  }
};

inline constexpr double kWidestConfusion = 12;  ///< px; what is blurred further is drawn as this

/// Radius (px) of the disc that a point at `depth` (m along the optical axis, 0: infinitely far)
/// becomes by a thin lens: half of aperture * focal * |1 / focus - 1 / depth|, with the focal
/// length in px; at most kWidestConfusion. Potmesil and Chakravarty, "A lens and aperture camera
/// model for synthetic image generation", 1981, of objects far beyond the focal length.
double confusion_radius(const DepthOfFieldConfig& lens, double focal, double depth);

/// Blurs an image of codes (CV_8UC3) in linear light by the depth of each pixel (CV_32FC1, m, 0:
/// infinitely far). Each pixel gets its share of the discs that reach it; what is behind does not
/// spread over what is nearer and sharper. What a near thing hides stays hidden where a lens would
/// see past its edge.
void blur_by_depth(cv::Mat& codes, const cv::Mat& depth, double focal,
                   const DepthOfFieldConfig& lens);

}  // namespace vinebench::sim
