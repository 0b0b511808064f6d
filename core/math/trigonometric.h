// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vinebench::elementary {

/// An angle within a quarter turn: quadrant * pi/2 + high + low, |high| <= pi/4.
struct ReducedAngle {
  int quadrant;  ///< 0 to 3
  long double high;
  long double low;
};

/// Of a finite angle.
ReducedAngle reduce_angle(double x);

}  // namespace vinebench::elementary
