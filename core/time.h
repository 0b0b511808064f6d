// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace vinebench {

/// Integer nanoseconds since the start of the scenario or recording.
using Stamp = std::int64_t;

inline constexpr Stamp kNanosecondsPerSecond = 1'000'000'000;

/// For arithmetic such as velocities and for output only; stamps are compared as integers.
inline double to_seconds(Stamp stamp) {
  return static_cast<double>(stamp) * 1e-9;
}

/// The nearest nanosecond.
Stamp from_seconds(double seconds);

/// Stamp of frame `index` at `rate_hz`, each rounded separately so that no error accumulates.
Stamp stamp_of_frame(std::int64_t index, double rate_hz);

/// Seconds with nine decimals, exact: "12.066666667".
std::string format_seconds(Stamp stamp);

/// Reads decimal seconds ("12.066666667", "1403715273.262142976") exactly if they have at most nine
/// decimals. Throws Error if `text` is not a number.
Stamp parse_seconds(const std::string& text);

}  // namespace vinebench
