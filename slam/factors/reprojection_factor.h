// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/cost_function.h>

#include "slam/factors/reprojection.h"

namespace vinebench::slam {

/// The same as a cost function of Ceres: parameters are the body's pose (7), the point (3) and,
/// where its calibration is unknown, T_body_cam of the camera (7) and the other numbers of
/// PairCalibration, in their order, against the camera given, and at last, where that is unknown,
/// the body's velocity (6, as PixelMeasurement has it).
class ReprojectionFactor : public ceres::CostFunction {
 public:
  /// What is unknown beside pose and point.
  struct Unknown {
    bool calibration = false;
    bool velocity = false;
  };

  ReprojectionFactor(const StereoCameraModel& camera, const PixelMeasurement& measurement,
                     Unknown unknown = {false, false});

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

  double chi_squared(const Pose& T_map_body, const Eigen::Vector3d& p_map) const {
    return Reprojection(*camera_, measurement_).chi_squared(T_map_body, p_map);
  }

 private:
  /// The camera that an unknown calibration makes of the given one.
  StereoCameraModel camera_of(double const* const* parameters) const;

  const StereoCameraModel* camera_;
  PixelMeasurement measurement_;
  Unknown unknown_;
};

}  // namespace vinebench::slam
