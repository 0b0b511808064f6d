// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "sim/assets/asset.h"

namespace vinebench::sim {

/// The orthographic view of a painted image.
struct PaintWindow {
  Eigen::Vector3f right;     ///< unit; grows along the image's columns
  Eigen::Vector3f towards;   ///< unit; towards the viewer; the image's up is z
  Eigen::Vector2f from, to;  ///< m, along `right` and z, of the lower left and upper right corner
  cv::Size size;             ///< px
};

struct PlantPainting {
  cv::Mat rgba;         ///< CV_8UC4, sRGB; alpha is the share of a pixel that is covered
  cv::Mat depth;        ///< CV_32F, m along `towards`; NaN where empty
  float occlusion = 1;  ///< mean over the visible pixels; the image has only the variation
};

/// Paints triangles for distant views: textures, and the light at each point relative to the mean,
/// for a vertical card.
PlantPainting paint_plant(const std::vector<Primitive>& parts, const std::vector<Texture>& textures,
                          const std::vector<Material>& materials, const PaintWindow& window);

}  // namespace vinebench::sim
