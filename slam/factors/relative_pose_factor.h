// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/sized_cost_function.h>

#include "core/geometry/pose.h"

namespace vinebench::slam {

/// How two keyframes' poses differ from what dead reckoning measured between them, in standard
/// deviations: parameters are the poses of the earlier and the later (7 each). The Jacobians take
/// the rotation's difference to be small.
class RelativePoseFactor : public ceres::SizedCostFunction<6, 7, 7> {
 public:
  RelativePoseFactor(const Pose& T_from_to, const Matrix6d& covariance);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  Pose T_from_to_;
  Matrix6d weight_;  ///< W with W^T W the inverse covariance
};

}  // namespace vinebench::slam
