// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "harness/explain/effects.h"
#include "harness/machine.h"
#include "tests/planted_causes/planted_cause.h"

namespace vinebench::planted {

inline constexpr double kHarm = 1.5;     // times the drift, or the lost frames
inline constexpr double kHarmLost = 3;   // frames
inline constexpr double kFloor = 0.001;  // m, added to each drift
inline constexpr int kDraws = 3;         // of the noise

/// What a drive does to the estimate: whole plain runs with several draws of the noise, none of
/// them one of explain's.
struct PlainRuns {
  std::vector<harness::StretchDrift> drifts{};

  double metres() const;  ///< geometric mean of the drifts with the floor
  double lost() const;    ///< mean, frames

  /// Whether these runs are worse than others by a fixed factor: 1.5 times the drift, or 1.5 times
  /// the lost frames and three more.
  bool are_worse_than(const PlainRuns& others) const;
};

/// Whether what was planted did harm, by runs with and without it alone.
struct Harm {
  PlainRuns with;
  PlainRuns without;             ///< none of it
  std::vector<PlainRuns> alone;  ///< of two: each of them alone

  /// One: with it is worse than without. Two: both together are worse than each alone; or both
  /// together and each alone are worse than none, where neither adds to the other. None: never.
  bool is_done() const;
  std::string text() const;
};

Harm measure_harm(const Case& one, const harness::Machine& machine);

}  // namespace vinebench::planted
