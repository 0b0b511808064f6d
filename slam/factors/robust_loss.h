// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "slam/camera/measurement_noise.h"

namespace vinebench::slam {

/// A loss of the squared norm s of a residual (in standard deviations): what it costs, and the
/// weight of its square in iteratively reweighted least squares (Huber 1964; Cauchy's by Black and
/// Anandan 1996). The same as Ceres's losses of these names.
class RobustLoss {
 public:
  static RobustLoss huber(double scale) { return {scale, false}; }
  static RobustLoss cauchy(double scale) { return {scale, true}; }

  double cost(double s) const {
    if (cauchy_) return scale_ * scale_ * std::log1p(s / (scale_ * scale_));
    return s <= scale_ * scale_ ? s : 2 * scale_ * std::sqrt(s) - scale_ * scale_;
  }
  double weight(double s) const {
    if (cauchy_) return 1 / (1 + s / (scale_ * scale_));
    return s <= scale_ * scale_ ? 1 : scale_ / std::sqrt(s);
  }

 private:
  RobustLoss(double scale, bool cauchy) : scale_(scale), cauchy_(cauchy) {}
  double scale_;
  bool cauchy_;
};

// Scales in standard deviations; Huber's is the 95 % of chi-square of a pixel.
inline constexpr double kCauchyScale = 1;
inline constexpr double kHuberScale = 2.4477;

/// Of a reprojection error near the solution.
inline RobustLoss residual_loss(ResidualLoss kind) {
  return kind == ResidualLoss::kHuber ? RobustLoss::huber(kHuberScale)
                                      : RobustLoss::cauchy(kCauchyScale);
}

}  // namespace vinebench::slam
