// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/cost_function.h>

#include "slam/camera/stereo_camera.h"

namespace vinebench::slam {

/// Reprojection error of a tag's corner: parameters are the body's pose (7) and the tag's (7).
class TagCornerFactor : public ceres::CostFunction {
 public:
  TagCornerFactor(const StereoCameraModel& camera, const Eigen::Vector2d& pixel, double sigma,
                  const Eigen::Vector3d& p_tag);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  const StereoCameraModel* camera_;
  Eigen::Vector2d pixel_;
  double sigma_;
  Eigen::Vector3d p_tag_;
};

}  // namespace vinebench::slam
