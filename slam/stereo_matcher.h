// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "slam/base/camera.h"
#include "slam/base/yaml.h"
#include "slam/orb_extractor.h"

namespace vinebench {

struct StereoConfig {
  double max_depth_baselines = 40;  ///< farther depths are not used (paper, Sect. III-A)
  int max_hamming = 75;             ///< bits
  template <class Archive>
  void serialize(Archive& archive) {
    archive("max_depth_baselines", max_depth_baselines, Range::positive());
    archive("max_hamming", max_hamming, Range::between(1, 256));
  }
};

/// For each keypoint of the left picture.
struct StereoMatch {
  float x_right = -1;  ///< px in the right picture, sub-pixel; -1 without a match
  float depth = -1;    ///< m along the optical axis; -1 without a match or beyond the limit
};

/// Matches a rectified pair (same lens, same rows) along the epipolar line: descriptor search on
/// the rows around, sub-pixel refinement by sliding a window over the right picture and a parabola,
/// then removal of outliers of the window's difference.
std::vector<StereoMatch> match_stereo(const Extraction& left, const Extraction& right,
                                      const PinholeCamera& camera, double baseline,
                                      const OrbExtractor& extractor, const StereoConfig& config);

}  // namespace vinebench
