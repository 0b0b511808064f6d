// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/geometry/pose.h"

namespace vinebench {

/// Of a pose with those standard deviations along (m) and about (rad) each of its axes.
Matrix6d isotropic_covariance(double offset, double turn);

/// The step (of step_of) of b that a step of a makes, where T_a_b does not change: as a matrix, the
/// adjoint of T_b_a.
Matrix6d carried_step(const Pose& T_a_b);

/// The covariance of T_map_b where T_map_b = T_map_a T_a_b and T_a_b is exact.
Matrix6d carry_covariance(const Matrix6d& of_a, const Pose& T_a_b);

}  // namespace vinebench
