// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "harness/realism/realism.h"

namespace vinebench::harness {

/// How far a set of ours lies from a real one: the mean over the statistics of the distance of the
/// medians, in halves of the real 10 to 90 % range, each at most 3.
double distance_of(const Realism& realism);

/// What a search among randomised settings found.
struct RealismFit {
  struct Candidate {
    std::int64_t draw = 0;  ///< seed of the draw
    double distance = 0;
    int inside = 0;
  };
  std::vector<Candidate> tried;       ///< nearest first
  std::vector<std::int64_t> nearest;  ///< draws of the quarter that lies nearest
  double distance_before = 0;         ///< median over all that were tried
};

/// Tries draws 1 to `count`; `measure` takes and measures pictures of a draw. Throws Error for
/// fewer than eight.
RealismFit search_settings(const PictureSet& real, int count,
                           const std::function<PictureSet(std::int64_t draw)>& measure);

}  // namespace vinebench::harness
