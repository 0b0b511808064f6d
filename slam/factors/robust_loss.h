// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

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

/// Loss of a reprojection error near the solution, in standard deviations. The errors of patches
/// have long tails, since some straddle a stem and the ground behind it, and those tails point one
/// way: what lies behind moves less. Huber's loss, which the paper uses, lets each of them pull as
/// hard as a good one; this one lets go of them.
inline constexpr double kCauchyScale = 1;

}  // namespace vinebench::slam
