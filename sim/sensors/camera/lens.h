// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/geometry/camera.h"

namespace vinebench::sim {

/// A band of rows of a camera's image and the ideal pinhole view for it.
struct LensBand {
  int top = 0;  ///< first row
  int rows = 0;
  PinholeCamera view;    ///< to be rendered, without distortion
  cv::Mat map;           ///< CV_16SC2 and CV_16UC1 as cv::convertMaps makes them: for each pixel of
  cv::Mat map_fraction;  ///< the rows its place in the view; empty where the view is the rows
  cv::Mat map_nearest;   ///< CV_16SC2: the view's pixel that is nearest to this place

  /// Resamples the view to the rows: bicubic for colours, nearest pixel for everything else.
  cv::Mat resample(const cv::Mat& image, bool nearest) const;
};

/// Splits a camera's image into `count` bands of rows, top first. The view of a distorted lens is a
/// pinhole with the same focal length, or up to 1.5 times that if the lens magnifies, so that no
/// detail is lost. Throws Error for a distortion that is not monotonic in the image or needs a view
/// of more than 8192 pixels a side.
std::vector<LensBand> make_lens_bands(const PinholeCamera& camera, int count);

}  // namespace vinebench::sim
