// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/cost_function.h>

#include <array>

#include "slam/camera/stereo_camera.h"

namespace vinebench::slam {

/// By what a tag's image may be off each time that it is seen, in the order of the block: px of
/// each corner, along x and y, and the share by which its sides are longer than they are said to
/// be.
struct TagErrors {
  static constexpr int kNumbers = 9;
  static constexpr int kSize = 8;
};

/// Reprojection error of a tag's corner where the tag camera's mounting is unknown, by how much its
/// images are taken later than they are stamped, and what the tag's image is off by: parameters are
/// the body's pose (7), the tag's (7), T_body_cam of the camera (7), that time (1, s), and
/// TagErrors (9).
class TagMeasureFactor : public ceres::CostFunction {
 public:
  /// `corner` is that of tag_corners() with this index, `sigma` in px. The pixel was brought to the
  /// frame's stamp for a camera with that time.
  TagMeasureFactor(const StereoCameraModel& camera, const Eigen::Vector2d& pixel, double sigma,
                   const Eigen::Vector3d& corner, int index, const Vector6d& velocity, double time);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  const StereoCameraModel* camera_;
  Eigen::Vector2d pixel_;
  double sigma_;
  Eigen::Vector3d corner_;
  int index_;
  Vector6d velocity_;  ///< of the body, in its own frame: m/s, rad/s
  double time_;
};

}  // namespace vinebench::slam
