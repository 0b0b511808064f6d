// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace vinebench::slam {

/// Loss of a reprojection error near the solution.
enum class ResidualLoss {
  /// The errors of patches have long tails, since some straddle a stem and the ground behind it,
  /// and
  /// those tails point one way: what lies behind moves less. This loss lets go of them.
  kCauchy,
  kHuber,  ///< the paper's, Eq. (1): each of them pulls as hard as a good one
};
inline std::vector<std::string> yaml_names(ResidualLoss) {
  return {"cauchy", "huber"};
}

/// How the cameras' measurements err.
struct MeasurementNoise {
  /// Pixels of level 0 to a pixel of each pyramid level: the standard deviation of a corner there.
  std::vector<double> level_scales;
  // Of a feature that is placed on its landmark's patch, px of its level.
  double placed_sigma = 0.15;
  double placed_disparity_sigma = 0.2;  ///< of its stereo match, besides
  /// The outliers' limit of such a feature in multiples of the usual one: its errors have long
  /// tails.
  double placed_tolerance = 2.3;
  ResidualLoss loss = ResidualLoss::kCauchy;
};

/// How far tags are to be trusted as measures of length: standard deviations.
struct TagAccuracy {
  double size = 0.001;      ///< share, of a tag's sides
  double corners = 0.3;     ///< px, by which a corner is off, alike each time and beside that
  double position = 0.005;  ///< m, of the tag cameras' mountings
  double rotation_deg = 0.3;
};

}  // namespace vinebench::slam
