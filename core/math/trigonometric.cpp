// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/math/trigonometric.h"

#include <array>
#include <cstdint>
#include <initializer_list>

#include "core/math/constants.h"
#include "core/math/elementary.h"

namespace vinebench::elementary {
namespace {

__extension__ using Wide = unsigned __int128;
using Words = std::array<std::uint64_t, 3>;  // the highest first

struct ExtendedSineCosine {
  long double sine;
  long double cosine;
};

constexpr double kTinyAngle = 0x1p-30;

bool is_finite(double x) {
  return x - x == 0;
}

/// Cody and Waite: the products of k are exact.
ReducedAngle reduce_small(double x) {
  const long double turns = x * kTwoByPi;
  const int k = static_cast<int>(turns + (turns < 0 ? -0.5L : 0.5L));
  const long double first = x - k * kHalfPiHigh;
  const long double second = k * kHalfPiMiddle;
  const long double sum = first - second;
  const long double part = sum - first;
  const long double rest = (first - (sum - part)) - (second + part);
  const long double low = rest - k * kHalfPiLow;
  const long double high = sum + low;
  return {k & 3, high, (sum - high) + low};
}

/// 192 binary digits of 2/pi from the given one on.
Words digits_of_two_by_pi(int first) {
  Words digits{};
  for (int i = 0; i < 3; ++i) {
    const int word = first / 64 + i;
    const int shift = first % 64;
    digits[static_cast<std::size_t>(i)] =
        kTwoByPiBits[word] << shift | (shift == 0 ? 0 : kTwoByPiBits[word + 1] >> (64 - shift));
  }
  return digits;
}

/// Payne and Hanek: the digits of 2/pi that make multiples of four quarter turns are left out.
ReducedAngle reduce_large(double magnitude) {
  int exponent = 0;
  const double fraction = __builtin_frexp(magnitude, &exponent);
  const auto significand = static_cast<std::uint64_t>(fraction * 0x1p53);
  const Words digits = digits_of_two_by_pi(exponent - 53 - 2 + 64);
  Words product{};
  std::uint64_t carry = 0;
  for (int i = 2; i >= 0; --i) {
    const auto at = static_cast<std::size_t>(i);
    const Wide term = static_cast<Wide>(digits[at]) * significand + carry;
    product[at] = static_cast<std::uint64_t>(term);
    carry = static_cast<std::uint64_t>(term >> 64);
  }
  // Two bits of quadrant, 190 of a fraction, which becomes -1/2 to 1/2.
  int quadrant = static_cast<int>(product[0] >> 62);
  const bool upper = (product[0] >> 61 & 1) != 0;
  auto lead = static_cast<std::int64_t>(product[0] << 2 | product[1] >> 62);
  if (upper) ++quadrant;  // the sign of `lead` takes the whole turn off
  const auto middle = product[1] << 2 | product[2] >> 62;
  const long double part = static_cast<long double>(lead) * 0x1p-64L +
                           (static_cast<long double>(middle) * 0x1p-128L +
                            static_cast<long double>(product[2] << 2) * 0x1p-192L);
  return {quadrant & 3, part * kHalfPi, 0};
}

/// Taylor's series to 2^-72 of the value at pi/4.
ExtendedSineCosine kernel(const ReducedAngle& angle) {
  const long double r = angle.high;
  const long double z = r * r;
  long double sine = 0;
  for (const long double c :
       {1 / 51090942171709440000.0L, -1 / 121645100408832000.0L, 1 / 355687428096000.0L,
        -1 / 1307674368000.0L, 1 / 6227020800.0L, -1 / 39916800.0L, 1 / 362880.0L, -1 / 5040.0L,
        1 / 120.0L, -1 / 6.0L}) {
    sine = c + sine * z;
  }
  long double cosine = 0;
  for (const long double c :
       {-1 / 1124000727777607680000.0L, 1 / 2432902008176640000.0L, -1 / 6402373705728000.0L,
        1 / 20922789888000.0L, -1 / 87178291200.0L, 1 / 479001600.0L, -1 / 3628800.0L, 1 / 40320.0L,
        -1 / 720.0L, 1 / 24.0L}) {
    cosine = c + cosine * z;
  }
  return {r + (r * z * sine + angle.low), 1 - (0.5L * z - (z * z * cosine - r * angle.low))};
}

ExtendedSineCosine sine_cosine(double x) {
  const ReducedAngle angle = reduce_angle(x);
  const auto [s, c] = kernel(angle);
  switch (angle.quadrant) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

}  // namespace

ReducedAngle reduce_angle(double x) {
  const double magnitude = x < 0 ? -x : x;
  if (magnitude < 0x1p20) return reduce_small(x);
  const ReducedAngle angle = reduce_large(magnitude);
  return x > 0 ? angle : ReducedAngle{-angle.quadrant & 3, -angle.high, 0};
}

double sin(double x) {
  if (!is_finite(x)) return x - x;
  if (x > -kTinyAngle && x < kTinyAngle) return x;
  return static_cast<double>(sine_cosine(x).sine);
}

double cos(double x) {
  if (!is_finite(x)) return x - x;
  return static_cast<double>(sine_cosine(x).cosine);
}

SineCosine sincos(double x) {
  if (!is_finite(x)) return {x - x, x - x};
  const auto [sine, cosine] = sine_cosine(x);
  const bool tiny = x > -kTinyAngle && x < kTinyAngle;
  return {tiny ? x : static_cast<double>(sine), static_cast<double>(cosine)};
}

double tan(double x) {
  if (!is_finite(x)) return x - x;
  if (x > -kTinyAngle && x < kTinyAngle) return x;
  const auto [sine, cosine] = sine_cosine(x);
  return static_cast<double>(sine / cosine);
}

}  // namespace vinebench::elementary
