// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/config/config_field.h"
#include "slam/features/features.h"

namespace vinebench::slam {

/// ORB features as in Sect. III-A of the paper.
struct OrbConfig {
  int features = 1000;         ///< an image, at most
  int levels = 8;              ///< of the scale pyramid
  double scale = 1.2;          ///< between levels
  int fast_threshold = 20;     ///< grey levels
  int fast_threshold_min = 7;  ///< grey levels; where a cell has no corner at fast_threshold
  int cell = 32;               ///< px; side of the cells that the adaptive threshold looks at
  int edge = 19;               ///< px; no keypoint is nearer to the image's edge, at any level
  template <class Archive>
  void serialize(Archive& archive) {
    archive("features", features, Range::between(10, 20000));
    archive("levels", levels, Range::between(1, 16));
    archive("scale", scale, Range::between(1.05, 2));
    archive("fast_threshold", fast_threshold, Range::between(1, 255));
    archive("fast_threshold_min", fast_threshold_min, Range::between(1, 255));
    archive("cell", cell, Range::between(8, 512));
    archive("edge", edge, Range::between(19, 200));
    archive.require(fast_threshold_min <= fast_threshold, "fast_threshold_min",
                    "expected at most fast_threshold");
  }
};

/// Features of an image, and the pyramid that they came from (stereo refinement reads it).
struct Extraction {
  Features features;
  std::vector<cv::Mat> pyramid;  ///< CV_8UC1, level 0 the full-size image
};

/// Stateless but for its tables: may be called from several threads at once.
class OrbExtractor {
 public:
  explicit OrbExtractor(const OrbConfig& config);

  /// `grey` is CV_8UC1. Same image, same result, to the bit.
  Extraction extract(const cv::Mat& grey) const;

  /// The scale pyramid alone, level 0 the image itself.
  std::vector<cv::Mat> pyramid(const cv::Mat& grey) const;

  /// Size of a pixel of that level in pixels of level 0.
  double scale_of(int level) const { return scales_[static_cast<std::size_t>(level)]; }

 private:
  OrbConfig config_;
  std::vector<double> scales_;
  std::vector<int> features_per_level_;
};

}  // namespace vinebench::slam
