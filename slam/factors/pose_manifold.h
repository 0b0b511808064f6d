// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ceres/manifold.h>

#include <array>

#include "core/geometry/pose.h"

namespace vinebench::slam {

/// A pose T_map_body as Ceres holds it: qx qy qz qw, x y z.
using PoseBlock = std::array<double, 7>;

PoseBlock to_block(const Pose& pose);
Pose from_block(const double* block);

/// Steps a pose in the body's own frame: T * step_of(step). Cost functions give their Jacobian for
/// that step in the first six columns of the block and zero in the seventh, which the plus-Jacobian
/// of this manifold takes over as they are.
class PoseManifold : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return 6; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;
};

}  // namespace vinebench::slam
