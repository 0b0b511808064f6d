// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace vinebench::slam {

/// Standard deviations of what the cameras measure.
struct MeasurementNoise {
  /// Pixels of level 0 to a pixel of each pyramid level: the standard deviation of a corner there.
  std::vector<double> level_scales;
  // Of a feature that is placed on its landmark's patch, px of its level.
  double placed_sigma = 0.15;
  double placed_disparity_sigma = 0.2;  ///< of its stereo match, besides
  /// The outliers' limit of such a feature in multiples of the usual one: its errors have long
  /// tails.
  double placed_tolerance = 2.3;
};

}  // namespace vinebench::slam
