// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "slam/stereo/stereo_matcher.h"

namespace vinebench::slam {

/// Indices of matches that were found, evenly taken out of all: `wanted` to twice as many, or all.
inline std::vector<std::size_t> sample_found(const std::vector<StereoMatch>& matches,
                                             std::size_t wanted) {
  const std::size_t every = std::max<std::size_t>(1, count_found(matches) / wanted);
  std::vector<std::size_t> sample;
  std::size_t seen = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (matches[i].x_right >= 0 && seen++ % every == 0) sample.push_back(i);
  }
  return sample;
}

}  // namespace vinebench::slam
