// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "slam/features/fast_cells.h"

namespace vinebench::slam {

/// Suppression via square covering (Bailo et al., "Efficient adaptive non-maximal suppression
/// algorithms for homogeneous spatial keypoint distribution", 2018): the strongest corners that
/// keep a square around them free of weaker ones. The square's side is found by bisection so that
/// nearly `count` and never more remain. Strongest first; equals by row, then column.
std::vector<Corner> suppress_square_covering(std::vector<Corner> corners, int count, int width,
                                             int height);

}  // namespace vinebench::slam
