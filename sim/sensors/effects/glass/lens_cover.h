// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "sim/sensors/effects/effect.h"
#include "sim/sensors/effects/fault_scope.h"

namespace vinebench::sim {

/// Something on the glass: it takes light and shines with a colour of its own, lit by the scene.
struct LensCover {
  FaultScope scope;
  cv::Mat opacity;          ///< CV_32FC1, 0 to 1
  cv::Vec3f glow{0, 0, 0};  ///< linear colour where it is opaque, of the image's mean light

  /// Onto linear light (CV_32FC3), in place.
  void apply(cv::Mat& light) const;
};

/// Paints the inside of an outline (px) with `opacity`, for covers that are made of shapes.
void fill_shape(cv::Mat& map, const std::vector<cv::Point2d>& outline, double opacity);

/// Out of focus by a standard deviation, px.
void defocus(cv::Mat& map, double sigma);

/// The effect of covers one after the other, each in its time. Null where there is none.
std::unique_ptr<LightEffect> make_cover_effect(std::vector<LensCover> covers);

}  // namespace vinebench::sim
