// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <string>

namespace vinebench {

/// Integer nanoseconds since the start of the scenario or recording.
using Stamp = std::int64_t;

inline constexpr Stamp kNanosecondsPerSecond = 1'000'000'000;

/// Readers refuse stamps that are further than this from 0 (146 years), so that the difference of
/// any two is a Stamp too.
inline constexpr Stamp kMostStamp = std::numeric_limits<Stamp>::max() / 2;

inline bool is_in_range(Stamp stamp) {
  return -kMostStamp <= stamp && stamp <= kMostStamp;
}

/// For arithmetic such as velocities and for output only; stamps are compared as integers.
inline double to_seconds(Stamp stamp) {
  return static_cast<double>(stamp) * 1e-9;
}

/// The nearest nanosecond, at most kMostStamp from 0.
Stamp from_seconds(double seconds);

/// Stamp of frame `index` at `rate_hz`, each rounded separately so that no error accumulates.
Stamp stamp_of_frame(std::int64_t index, double rate_hz);

/// Seconds with nine decimals, exact: "12.066666667".
std::string format_seconds(Stamp stamp);

/// Reads decimal seconds ("12.066666667", "1403715273.262142976") exactly if they have at most nine
/// decimals. Throws Error if `text` is not a number or beyond kMostStamp.
Stamp parse_seconds(const std::string& text);

}  // namespace vinebench
