// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/math/exponential.h"

#include <initializer_list>

#include "core/math/constants.h"
#include "core/math/elementary.h"

namespace vinebench::elementary {
namespace {

constexpr double kTiny = 0x1p-60;

/// e^x - 1 with 64 bits, for finite x.
long double expm1_extended(long double x) {
  if (x < -0.35L || x > 0.35L) return exp_extended(x, 0) - 1;
  long double sum = 1;
  for (int n = 18; n > 1; --n) sum = 1 + sum * x / static_cast<long double>(n);
  return x * sum;
}

bool is_infinite(double x) {
  return x - x != 0;  // also of NaN
}

}  // namespace

long double exp_extended(long double x, long double low) {
  constexpr long double kLimit = 11000;
  if (x > kLimit) return exp_extended(kLimit, 0);
  if (x < -kLimit) return exp_extended(-kLimit, 0);
  const long double scaled = x * (32 * kLog2E);
  const int k = static_cast<int>(scaled + (scaled < 0 ? -0.5L : 0.5L));
  const long double r = ((x - k * kLn2By32High) - k * kLn2By32Low) + low;  // below ln(2)/64
  // Taylor's series: |r|^9/9! is below 2^-77.
  long double p = 1 / 40320.0L;
  for (const long double c : {1 / 5040.0L, 1 / 720.0L, 1 / 120.0L, 1 / 24.0L, 1 / 6.0L, 0.5L}) {
    p = c + p * r;
  }
  p = r + r * r * p;
  const long double power = kPowersOfTwo[k & 31];
  return __builtin_ldexpl(power + power * p, k >> 5);
}

double exp(double x) {
  if (x != x) return x + x;
  return static_cast<double>(exp_extended(x, 0));
}

double exp2_of_float(float x) {
  if (x != x) return x + x;
  return static_cast<double>(exp_extended(x * kLn2, 0));
}

double expm1(double x) {
  if (x != x || (x > -kTiny && x < kTiny)) return x;
  if (x < -50) return -1 + 0x1p-60;
  return static_cast<double>(expm1_extended(x));
}

double sinh(double x) {
  if (is_infinite(x) || (x > -kTiny && x < kTiny)) return x;
  const long double grown = expm1_extended(x < 0 ? -x : x);
  const long double value = 0.5L * (grown + grown / (grown + 1));
  return static_cast<double>(x < 0 ? -value : value);
}

double cosh(double x) {
  if (is_infinite(x)) return x * x;
  const long double grown = exp_extended(x < 0 ? -x : x, 0);
  return static_cast<double>(0.5L * (grown + 1 / grown));
}

double tanh(double x) {
  if (x != x || (x > -kTiny && x < kTiny)) return x;
  if (x > 30) return 1;
  if (x < -30) return -1;
  const long double grown = expm1_extended(2 * static_cast<long double>(x));
  return static_cast<double>(grown / (grown + 2));
}

}  // namespace vinebench::elementary
