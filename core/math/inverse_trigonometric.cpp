// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/math/constants.h"
#include "core/math/elementary.h"

namespace vinebench::elementary {
namespace {

constexpr double kTinySlope = 0x1p-30;

/// atan(q) of 0 <= q <= 1.
long double arc_tangent(long double q) {
  const int i = static_cast<int>(16 * q + 0.5L);
  const long double centre = i / 16.0L;
  const long double d = i == 0 ? q : (q - centre) / (1 + q * centre);  // within 1/32
  const long double z = d * d;
  long double p = 0;
  for (int n = 17; n > 1; n -= 2) p = (n % 4 == 1 ? 1 : -1) / static_cast<long double>(n) + p * z;
  return kArcTangents[i] + (d + d * z * p);
}

/// The angle of (x, y) in the first quadrant; not both zero.
long double angle_of(long double y, long double x) {
  return y <= x ? arc_tangent(y / x) : kHalfPi - arc_tangent(x / y);
}

/// The cosine of the angle whose sine is x, and the reverse.
long double other_side(long double x) {
  return __builtin_sqrtl((1 - x) * (1 + x));
}

/// Of operands of which none is NaN: as numbers whose quotient is defined.
long double angle_with_limits(double y, double x) {
  const bool infinite_y = y - y != 0;
  const bool infinite_x = x - x != 0;
  if (infinite_y && infinite_x) return kHalfPi / 2;
  if (infinite_y) return kHalfPi;
  if (infinite_x || (y == 0)) return 0;
  return angle_of(y, x);
}

}  // namespace

double atan(double x) {
  if (x != x || (x > -kTinySlope && x < kTinySlope)) return x;
  const long double angle =
      x - x != 0 ? kHalfPi : angle_of(x < 0 ? -static_cast<long double>(x) : x, 1);
  return static_cast<double>(x < 0 ? -angle : angle);
}

double atan2(double y, double x) {
  if (x != x || y != y) return x + y;
  long double angle = angle_with_limits(__builtin_fabs(y), __builtin_fabs(x));
  if (__builtin_signbit(x) != 0) angle = kPi - angle;
  return static_cast<double>(__builtin_signbit(y) != 0 ? -angle : angle);
}

double asin(double x) {
  if (!(x >= -1 && x <= 1)) return (x - x) / 0.0;
  if (x > -kTinySlope && x < kTinySlope) return x;
  const long double side = x < 0 ? -static_cast<long double>(x) : x;
  const long double angle = angle_of(side, other_side(side));
  return static_cast<double>(x < 0 ? -angle : angle);
}

double acos(double x) {
  if (!(x >= -1 && x <= 1)) return (x - x) / 0.0;
  const long double side = x < 0 ? -static_cast<long double>(x) : x;
  const long double angle = angle_of(other_side(side), side);
  return static_cast<double>(x < 0 ? kPi - angle : angle);
}

}  // namespace vinebench::elementary
