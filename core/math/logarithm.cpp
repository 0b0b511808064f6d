// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/math/logarithm.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include "core/math/constants.h"
#include "core/math/elementary.h"
#include "core/math/exponential.h"

namespace vinebench::elementary {
namespace {

constexpr double kInfinity = __builtin_inf();
constexpr double kLeastNormal = 0x1p-1022;
constexpr double kLargestInteger = 0x1p53;  // doubles from here on are even

/// The value of a logarithm where it is no number of log_extended, else nothing.
bool special_logarithm(double x, double& value) {
  if (x > 0 && x < kInfinity) return false;
  value = x == 0 ? -1 / (x * x) : x < 0 ? (x - x) / 0.0 : x + x;
  return true;
}

double logarithm(double x, long double scale) {
  double value = 0;
  if (special_logarithm(x, value)) return value;
  const ExtendedSum log = log_extended(x);
  return static_cast<double>((log.high + log.low) * scale);
}

/// Lower parts of the table as doubles.
constexpr std::array kLowParts = [] {
  std::array<double, std::size(kLogarithms)> low{};
  for (std::size_t i = 0; i < low.size(); ++i) low[i] = static_cast<double>(kLogarithms[i].low);
  return low;
}();

/// ln(x) + rest of a positive, normal x, where that is so far from the middle of two doubles that
/// it is rounded as the exact value is (Ziv, ACM TOMS 17, 1991); false elsewhere, once in a hundred
/// times. The series is summed in doubles: less than half of log_extended's time.
bool quick_log(double x, double rest, double& value) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  int k = static_cast<int>(bits >> 52) - 1023;
  double m = std::bit_cast<double>((bits & 0xfffffffffffffU) | 0x3ff0000000000000U);
  if (m >= 1.4140625) {
    m /= 2;
    ++k;
  }
  const int n = static_cast<int>(128 / m + 0.5);
  const long double exact = m * (static_cast<long double>(n) / 128) - 1;
  const auto r = static_cast<double>(exact);
  const double p =
      -1.0 / 2 +
      r * (1.0 / 3 +
           r * (-1.0 / 4 +
                r * (1.0 / 5 +
                     r * (-1.0 / 6 +
                          r * (1.0 / 7 + r * (-1.0 / 8 + r * (1.0 / 9 + r * (-1.0 / 10))))))));
  const auto entry = static_cast<std::size_t>(n - 90);
  const double low = k * static_cast<double>(kLn2Low) + kLowParts[entry] + rest + r * r * p;
  const long double sum = (k * kLn2High + kLogarithms[entry].high) + exact + low;
  // A few roundings of r^2 / 2 to 53 bits, what the series leaves out, and two of the sum to 64.
  const long double error = 0x1p-51 * (r * r) + 0x1p-62L * (sum < 0 ? -sum : sum);
  value = static_cast<double>(sum - error);
  return value == static_cast<double>(sum + error);
}

/// High part with 32 bits (Veltkamp).
long double upper_half(long double x) {
  const long double scaled = x * 0x1.00000001p32L;
  return scaled - (scaled - x);
}

/// The exact product of numbers of 64 bits (Dekker).
ExtendedSum exact_product(long double a, long double b) {
  const long double product = a * b;
  const long double a1 = upper_half(a);
  const long double b1 = upper_half(b);
  const long double a2 = a - a1;
  const long double b2 = b - b1;
  return {product, a2 * b2 - (((product - a1 * b1) - a2 * b1) - a1 * b2)};
}

bool is_integer(double y) {
  if (y >= kLargestInteger || y <= -kLargestInteger) return true;
  return static_cast<double>(static_cast<long long>(y)) == y;
}

bool is_odd(double y) {
  if (y >= kLargestInteger || y <= -kLargestInteger) return false;
  return (static_cast<long long>(y) & 1) != 0 && is_integer(y);
}

/// |x|^y where one of them is zero or infinite, y not zero.
double power_at_limits(double magnitude, double y) {
  if (y - y != 0) {  // y is infinite
    if (magnitude == 1) return 1;
    return (magnitude > 1) == (y > 0) ? kInfinity : 0.0;
  }
  if (magnitude == 0) return y > 0 ? 0.0 : 1 / magnitude;
  return y > 0 ? kInfinity : 0.0;
}

long double positive_power(double x, double y) {
  const ExtendedSum log = log_extended(x);
  if (log.high * y > 11000 || log.high * y < -11000) return exp_extended(log.high * y, 0);
  const ExtendedSum exponent = exact_product(log.high, y);
  return exp_extended(exponent.high, exponent.low + log.low * y);
}

}  // namespace

ExtendedSum log_extended(long double x) {
  int k = 0;
  long double m = 2 * __builtin_frexpl(x, &k);  // 1 to 2
  --k;
  if (m >= 1.4140625L) {
    m /= 2;
    ++k;
  }
  // c is a multiple of 1/128 within 2^-7 of 1/m, so that m c - 1 is exact for doubles.
  const int n = static_cast<int>(128 / m + 0.5L);
  const long double r = m * (static_cast<long double>(n) / 128) - 1;
  const LogEntry& entry = kLogarithms[n - 90];
  long double p = 1 / 13.0L;
  for (int i = 12; i > 1; --i) p = (i % 2 != 0 ? 1 : -1) / static_cast<long double>(i) + p * r;
  const long double high = k * kLn2High + entry.high;
  // Knuth's exact sum of high and r.
  const long double sum = high + r;
  const long double part = sum - high;
  const long double rest = (high - (sum - part)) + (r - part);
  const long double low = rest + (k * kLn2Low + entry.low + r * r * p);
  const long double whole = sum + low;
  return {whole, (sum - whole) + low};
}

double log(double x) {
  double value = 0;
  if (x >= kLeastNormal && x < kInfinity && quick_log(x, 0, value)) return value;
  return logarithm(x, 1);
}

double log2(double x) {
  return logarithm(x, kLog2E);
}

double log10(double x) {
  return logarithm(x, kLog10E);
}

double log1p(double x) {
  if (x > -0x1p-60 && x < 0x1p-60) return x;
  double value = 0;
  if (!(x > -1) || x == kInfinity) {
    special_logarithm(x == -1 ? 0.0 : x, value);
    return value;
  }
  const double sum = 1 + x;
  const long double rest = x > 1 ? 1 - (sum - x) : x - (sum - 1);  // exact
  if (sum >= kLeastNormal && quick_log(sum, static_cast<double>(rest) / sum, value)) return value;
  const ExtendedSum log = log_extended(sum);
  return static_cast<double>(log.high + (log.low + rest / sum));
}

double pow(double x, double y) {
  if (y == 0 || x == 1) return 1;
  if (x != x || y != y) return x + y;
  const double magnitude = __builtin_fabs(x);
  const bool negative = __builtin_signbit(x) != 0 && is_odd(y);
  double value = 0;
  if (magnitude == 0 || magnitude == kInfinity || y - y != 0) {
    value = power_at_limits(magnitude, y);
  } else {
    if (x < 0 && !is_integer(y)) return (x - x) / 0.0;
    value = static_cast<double>(positive_power(magnitude, y));
  }
  return negative ? -value : value;
}

}  // namespace vinebench::elementary
