// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/math/elementary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/util/random.h"

namespace vinebench {
namespace {

using Function = std::function<double(double)>;
using Reference = std::function<long double(long double)>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr int kSamples = 20000;

/// The distance in units of the last place of the double next to `expected`.
double ulps(double value, long double expected) {
  int exponent = 0;
  std::frexp(static_cast<double>(expected), &exponent);
  const long double unit = std::ldexp(1.0L, std::max(exponent - 53, -1074));
  return static_cast<double>(std::fabs(value - expected) / unit);
}

double worst_error(const Function& function, const Reference& reference, double low, double high) {
  const RandomStream random(1, "elementary");
  double worst = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double x = low + (high - low) * random.uniform(static_cast<std::uint64_t>(i));
    worst = std::max(worst, ulps(function(x), reference(x)));
  }
  return worst;
}

bool same(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) || (a == b && std::signbit(a) == std::signbit(b));
}

// Rounding takes half a unit; the C library's 80-bit functions err by less than 2^-62 of the value,
// 1/512 of a unit, ours by the same.
constexpr double kUlps = 0.505;

#define EXPECT_EXACT(name, low, high)                                           \
  EXPECT_LT(worst_error([](double x) { return elementary::name(x); },           \
                        [](long double x) { return std::name(x); }, low, high), \
            kUlps)                                                              \
      << #name " from " << (low)

TEST(Elementary, IsRoundedFromTheTrueValue) {
  EXPECT_EXACT(exp, -700, 700);
  EXPECT_EXACT(exp, -1, 1);
  EXPECT_EXACT(expm1, -1, 1);
  EXPECT_EXACT(expm1, -40, 700);
  EXPECT_EXACT(sinh, -2, 2);
  EXPECT_EXACT(cosh, -20, 20);
  EXPECT_EXACT(tanh, -2, 2);
  EXPECT_EXACT(log, 1e-300, 1e-290);
  EXPECT_EXACT(log, 0.99, 1.01);
  EXPECT_EXACT(log, 0.3, 1e6);
  EXPECT_EXACT(log2, 0.3, 1e6);
  EXPECT_EXACT(log10, 0.3, 1e6);
  EXPECT_EXACT(log1p, -0.9, 3);
  EXPECT_EXACT(log1p, -0.01, 0.01);
  EXPECT_EXACT(sin, -10, 10);
  EXPECT_EXACT(cos, -10, 10);
  EXPECT_EXACT(tan, -10, 10);
  EXPECT_EXACT(sin, 1e4, 1e6);
  EXPECT_EXACT(asin, -1, 1);
  EXPECT_EXACT(acos, -1, 1);
  EXPECT_EXACT(atan, -20, 20);
  EXPECT_EXACT(erfc, 2, 26);
}

TEST(Elementary, ComplementaryErrorFunctionLosesLittleByCancellation) {
  // 1 - erf with 64 bits at erfc(1.5) = 0.034 = 2^-4.9: some 2^-58 of the value, 1/32 of a unit an
  // operation of the series.
  EXPECT_LT(worst_error([](double x) { return elementary::erfc(x); },
                        [](long double x) { return std::erfc(x); }, -6, 2),
            0.7);
}

TEST(Elementary, PowersAreRoundedFromTheTrueValue) {
  // powl errs by less than 1/512 of a double's unit.
  const RandomStream random(2, "elementary");
  double worst = 0;
  for (std::uint64_t i = 0; i < kSamples; ++i) {
    const double x = std::exp2(2000 * random.uniform(2 * i) - 1000);
    const double y = (2 * random.uniform(2 * i + 1) - 1) * 1000 / std::log2(x);
    worst = std::max(worst, ulps(elementary::pow(x, y), std::pow<long double>(x, y)));
    const double near_one = 1 + 1e-3 * (random.uniform(2 * i) - 0.5);
    const double steep = 1e5 * (random.uniform(2 * i + 1) - 0.5);
    worst = std::max(
        worst, ulps(elementary::pow(near_one, steep), std::pow<long double>(near_one, steep)));
  }
  EXPECT_LT(worst, kUlps);
  EXPECT_EQ(elementary::pow(3, 20), 3486784401.0);
  EXPECT_EQ(elementary::pow(-2, 3), -8);
  EXPECT_EQ(elementary::pow(4, 0.5), 2);
}

TEST(Elementary, AnglesOfAllDirectionsAreRoundedFromTheTrueValue) {
  const RandomStream random(3, "elementary");
  double worst = 0;
  for (std::uint64_t i = 0; i < kSamples; ++i) {
    const double y = random.uniform(2 * i) - 0.5;
    const double x = random.uniform(2 * i + 1) - 0.5;
    worst = std::max(worst, ulps(elementary::atan2(y, x), std::atan2<long double>(y, x)));
  }
  EXPECT_LT(worst, kUlps);
}

TEST(Elementary, HugeAnglesAreReducedWithEnoughDigits) {
  // The sine of 10^22 is a known test of a reduction (Ng, "Good to the last bit", 1992):
  // -0.8522008497671888.
  EXPECT_NEAR(elementary::sin(1e22), -0.8522008497671888, 2e-16);
  EXPECT_EXACT(sin, 1e7, 1e15);
  EXPECT_EXACT(cos, 1e7, 1e15);
  EXPECT_EXACT(tan, 1e250, 1e300);
  EXPECT_EQ(elementary::sin(-1e100), -elementary::sin(1e100));
  EXPECT_EQ(elementary::cos(-1e100), elementary::cos(1e100));
}

TEST(Elementary, SpecialValuesAreThoseOfTheStandard) {
  for (const double x : {0.0, -0.0, 1.0, -1.0, 0.5, -2.0, 3.0, -3.0, kInfinity, -kInfinity, kNan,
                         1e308, 5e-324, -5e-324, 800.0, -800.0}) {
    const auto expect_same = [x](const char* name, double value, double expected) {
      // Those of the C library may be a unit away where they are finite.
      EXPECT_TRUE(same(value, expected) ||
                  std::fabs(value - expected) < 3e-16 * std::fabs(expected))
          << name << "(" << x << ") = " << value << ", expected " << expected;
    };
#define EXPECT_SPECIAL(name) expect_same(#name, elementary::name(x), std::name(x))
    EXPECT_SPECIAL(exp), EXPECT_SPECIAL(expm1), EXPECT_SPECIAL(sinh), EXPECT_SPECIAL(cosh);
    EXPECT_SPECIAL(tanh), EXPECT_SPECIAL(log), EXPECT_SPECIAL(log2), EXPECT_SPECIAL(log10);
    EXPECT_SPECIAL(log1p), EXPECT_SPECIAL(sin), EXPECT_SPECIAL(cos), EXPECT_SPECIAL(tan);
    EXPECT_SPECIAL(asin), EXPECT_SPECIAL(acos), EXPECT_SPECIAL(atan), EXPECT_SPECIAL(erfc);
    for (const double y :
         {0.0, -0.0, 1.0, -1.0, 0.5, 2.0, 3.0, -3.0, kInfinity, -kInfinity, kNan}) {
      expect_same("pow", elementary::pow(x, y), std::pow(x, y));
      expect_same("atan2", elementary::atan2(x, y), std::atan2(x, y));
    }
    const auto [sine, cosine] = elementary::sincos(x);
    EXPECT_TRUE(same(sine, elementary::sin(x)) && same(cosine, elementary::cos(x))) << x;
  }
}

TEST(Elementary, PowersOfTwoAreExact) {
  for (int k = -149; k <= 127; ++k) {
    EXPECT_EQ(elementary::exp2_of_float(static_cast<float>(k)), std::ldexp(1.0, k));
    EXPECT_EQ(elementary::log2(std::ldexp(1.0, k)), k);
  }
}

}  // namespace
}  // namespace vinebench
