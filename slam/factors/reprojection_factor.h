// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/cost_function.h>

#include "slam/factors/reprojection.h"

namespace vinebench::slam {

/// The same as a cost function of Ceres: parameters are the body's pose (7), the point (3) and,
/// where it is an unknown, the camera's disparity offset (1), which the right camera alone
/// measures.
class ReprojectionFactor : public ceres::CostFunction {
 public:
  ReprojectionFactor(const StereoCameraModel& camera, const PixelMeasurement& measurement,
                     bool offset_unknown = false);

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

  double chi_squared(const Pose& T_map_body, const Eigen::Vector3d& p_map) const {
    return reprojection_.chi_squared(T_map_body, p_map);
  }

 private:
  Reprojection reprojection_;
};

}  // namespace vinebench::slam
