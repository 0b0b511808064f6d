// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/time.h"

#include <cerrno>
#include <cmath>
#include <cstdlib>

#include "core/util/error.h"

namespace vinebench {

Stamp from_seconds(double seconds) {
  const double nanoseconds = seconds * static_cast<double>(kNanosecondsPerSecond);
  // As a double kMostStamp is one more, which a Stamp can hold.
  const auto most = static_cast<double>(kMostStamp);
  if (nanoseconds >= most) return kMostStamp;
  if (nanoseconds <= -most) return -kMostStamp;
  return static_cast<Stamp>(std::llround(nanoseconds));
}

Stamp stamp_of_frame(std::int64_t index, double rate_hz) {
  const auto whole = static_cast<std::int64_t>(std::llround(rate_hz));
  if (static_cast<double>(whole) == rate_hz) {
    return (index * kNanosecondsPerSecond + whole / 2) / whole;
  }
  return from_seconds(static_cast<double>(index) / rate_hz);
}

std::string format_seconds(Stamp stamp) {
  const bool negative = stamp < 0;
  const Stamp magnitude = negative ? -stamp : stamp;
  return fmt::format("{}{}.{:09d}", negative ? "-" : "", magnitude / kNanosecondsPerSecond,
                     magnitude % kNanosecondsPerSecond);
}

Stamp parse_seconds(const std::string& text) {
  const std::size_t first_digit = text.find_first_not_of("+-");
  const bool plain = text.find_first_of("0123456789") != std::string::npos &&
                     text.find_first_not_of("+-0123456789.") == std::string::npos;
  const std::size_t dot = text.find('.');
  const std::size_t decimals = dot == std::string::npos ? 0 : text.size() - dot - 1;
  if (!plain || decimals > 9 || first_digit > 1) {
    char* end = nullptr;
    const double seconds = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !(std::abs(seconds) < to_seconds(kMostStamp))) {
      fail("expected a time in seconds, found '{}'", text);
    }
    return from_seconds(seconds);
  }
  std::string digits = text.substr(0, dot);
  if (dot != std::string::npos) digits += text.substr(dot + 1);
  digits.append(9 - decimals, '0');
  char* end = nullptr;
  errno = 0;
  const Stamp stamp = std::strtoll(digits.c_str(), &end, 10);
  if (*end != '\0' || errno == ERANGE || !is_in_range(stamp)) {
    fail("expected a time in seconds, found '{}'", text);
  }
  return stamp;
}

}  // namespace vinebench
