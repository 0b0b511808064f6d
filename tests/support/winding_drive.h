// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "core/geometry/pose.h"

namespace vinebench::test {

/// Of a winding drive along an aisle, 10 cm a keyframe. Only the velocities' variety matters to
/// calibrations: the keyframes need not follow from them.
inline Pose winding(int keyframe) {
  return {exp_so3({0, 0, 0.3 * std::sin(0.5 * keyframe)}),
          {0.1 * keyframe, 0.1 * std::sin(0.3 * keyframe), 0}};
}

/// Body frame; m/s and rad/s.
inline Vector6d winding_velocity(int keyframe) {
  Vector6d twist = Vector6d::Zero();
  twist[0] = 0.4 + 0.2 * std::sin(0.9 * keyframe);
  twist[1] = 0.1 * std::cos(0.7 * keyframe);
  twist[5] = 0.6 * std::cos(0.5 * keyframe);
  return twist;
}

}  // namespace vinebench::test
