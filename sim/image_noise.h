// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "slam/base/yaml.h"

namespace vinebench {

/// Noise of an image sensor, in grey levels of the 8-bit picture.
struct ImageNoiseConfig {
  double sigma = 1.5;  ///< standard deviation, grey levels; 0 switches it off
  template <class Archive>
  void serialize(Archive& archive) {
    archive("sigma", sigma, Range::between(0, 50));
  }
};

/// Adds Gaussian noise to a CV_8U picture of one or three channels, in place. A draw is a function
/// of (seed, camera, frame, pixel) alone.
void add_image_noise(cv::Mat& image, const ImageNoiseConfig& config, std::uint64_t seed, int camera,
                     std::int64_t frame);

}  // namespace vinebench
