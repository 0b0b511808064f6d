// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/config/config_field.h"
#include "slam/patches/patch.h"

namespace vinebench::slam {

/// Fine placement of matches on the landmark's patch.
struct RefinementConfig {
  bool enabled = true;         ///< whether matches are placed finely
  double max_residual = 0.35;  ///< mean difference to the patch as a share of its contrast, at most
  double noise = 2.0;          ///< grey levels, difference that the sensor's noise alone explains
  double sigma = 0.15;         ///< px of the feature's level, standard deviation once placed
  double disparity_sigma = 0.2;  ///< px of the feature's level, of a stereo match
  double tolerance = 2.3;  ///< the outliers' limit in multiples of the usual one: tails are long
  int follow = 1200;  ///< landmarks a view that are looked for by their patch, with those matched

  /// Whether the patch was found where it fits best.
  bool accepts(const PatchFit& fit) const {
    return fit.difference <= noise + max_residual * fit.contrast;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive("enabled", enabled);
    archive("max_residual", max_residual, Range::between(0, 2));
    archive("noise", noise, Range::between(0, 50));
    archive("sigma", sigma, Range::between(0.01, 5));
    archive("disparity_sigma", disparity_sigma, Range::between(0.01, 5));
    archive("tolerance", tolerance, Range::between(1, 10));
    archive("follow", follow, Range::non_negative());
  }
};

}  // namespace vinebench::slam
