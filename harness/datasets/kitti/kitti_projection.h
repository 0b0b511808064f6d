// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "core/geometry/rig.h"

namespace vinebench::harness {

/// K [I | t] of a rectified camera, whose points are in the axes of the first one.
using Projection = Eigen::Matrix<double, 3, 4>;

inline constexpr const char* kProjectionExpected =
    "expected a projection matrix: focal lengths above 0, 1 in row 3, column 3";

bool is_projection(const Projection& P);

/// Its lens, without the size, and its place on the first camera.
RigCamera camera_of_projection(const Projection& P);

}  // namespace vinebench::harness
