// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/math/constants.h"
#include "core/math/elementary.h"
#include "core/math/exponential.h"

namespace vinebench::elementary {
namespace {

/// erf(x) of 0 <= x < 1.5: M. Abramowitz and I. Stegun, 7.1.6, all of whose terms are positive.
long double error_series(long double x, long double gauss) {
  long double term = x;
  long double sum = x;
  for (int n = 1; n < 80 && term > sum * 0x1p-68L; ++n) {
    term *= 2 * x * x / static_cast<long double>(2 * n + 1);
    sum += term;
  }
  return kTwoBySqrtPi * gauss * sum;
}

/// erfc(x) of x >= 1.5: the continued fraction 7.1.14, from a level up that suffices for 64 bits.
long double complementary_fraction(long double x, long double gauss) {
  long double level = x;
  for (int n = 20 + static_cast<int>(480 / (x * x)); n > 0; --n) level = x + (n / 2.0L) / level;
  return 0.5L * kTwoBySqrtPi * gauss / level;
}

}  // namespace

double erfc(double x) {
  if (x != x) return x;
  if (x > 28) return 0;
  if (x < -7) return 2;
  const long double side = x < 0 ? -static_cast<long double>(x) : x;
  // The square needs up to 106 bits.
  const long double square = side * side;
  const auto upper = static_cast<long double>(static_cast<float>(side));
  const long double lower = side - upper;
  const long double rest = (upper * upper - square) + 2 * upper * lower + lower * lower;
  const long double gauss = exp_extended(-square, -rest);
  const long double value =
      side < 1.5L ? 1 - error_series(side, gauss) : complementary_fraction(side, gauss);
  return static_cast<double>(x < 0 ? 2 - value : value);
}

}  // namespace vinebench::elementary
