// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "sim/render/gl/platform/gl.h"

namespace vinebench::sim {

/// Reads the target that is bound. A few rows at a time, which stay in the processor's cache until
/// they are converted. The clip space is mirrored so that OpenGL's first row is the image's top
/// one.
class ReadBack {
 public:
  /// RGB (CV_8UC3), and alpha as labels (CV_8UC1).
  void colours(const GlFunctions& gl, const cv::Size& size, cv::Mat& rgb, cv::Mat& labels);
  /// z along the optical axis, m (CV_32FC1); 0 where there is nothing but sky.
  void depth(const GlFunctions& gl, const cv::Size& size, cv::Mat& depth);
  /// RenderedImage::instances.
  void instances(const GlFunctions& gl, const cv::Size& size, cv::Mat& numbers);
  /// RenderedImage::normals, to 1.5e-5.
  void normals(const GlFunctions& gl, const cv::Size& size, cv::Mat& normals);
  /// RenderedImage::motion by the wind.
  void motion(const GlFunctions& gl, const cv::Size& size, cv::Mat& motion);

 private:
  /// Hands each row's pixels to `take`, as bytes.
  template <class Take>
  void rows(const GlFunctions& gl, const cv::Size& size, GLenum format, GLenum type,
            std::size_t pixel, const Take& take);

  std::vector<std::uint8_t> strip_;
};

}  // namespace vinebench::sim
