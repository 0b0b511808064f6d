// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "slam/features/orb_extractor.h"

namespace vinebench::slam {

/// Stereo correspondences between features of both images that respect the epipolar constraint
/// (paper, Sect. III-A).
class FeatureSearch {
 public:
  /// The right image's features must outlive it; `rows` is the images' height, px.
  FeatureSearch(const Features& right, int rows, const OrbExtractor& extractor);

  /// Disparity of the feature of the right image that is most like this one of the left, px, above
  /// 0 and at most `max_disparity`: on the same row within two pixels of its level, at most a level
  /// apart. Empty without one, and where another is nearly as much alike.
  std::optional<double> disparity_of(const Keypoint& left, const Descriptor& descriptor,
                                     double max_disparity) const;

 private:
  const Features& right_;
  const OrbExtractor& extractor_;
  std::vector<std::vector<std::size_t>> on_row_;  ///< features by the row that they lie on
};

}  // namespace vinebench::slam
