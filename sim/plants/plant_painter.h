// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "sim/assets/asset.h"

namespace vinebench::sim {

/// What part of the model a painted image shows, without perspective.
struct PaintWindow {
  Eigen::Vector3f right;     ///< unit; grows along the image's columns
  Eigen::Vector3f towards;   ///< unit; to who looks at it; the image's up is z
  Eigen::Vector2f from, to;  ///< m, along `right` and z, of the lower left and upper right corner
  cv::Size size;             ///< px
};

struct PlantPainting {
  cv::Mat rgba;         ///< CV_8UC4, sRGB; alpha is the share of a pixel that is covered
  cv::Mat depth;        ///< CV_32F, m along `towards`; NaN where nothing is
  float occlusion = 1;  ///< mean of what is seen; the image holds only how it varies
};

/// Paints triangles as they look from afar: textures, and the light that reaches each place
/// relative to the mean of all, for a card that stands upright.
PlantPainting paint_plant(const std::vector<Primitive>& parts, const std::vector<Texture>& textures,
                          const std::vector<Material>& materials, const PaintWindow& window);

}  // namespace vinebench::sim
