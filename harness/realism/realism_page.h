// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "harness/realism/realism.h"

namespace vinebench::harness {

/// A set of ours with what it was compared with.
struct RealismEntry {
  Realism realism;
  PictureSet ours;
};

/// One self-contained HTML page: for each of ours a table of the statistics with their place in the
/// real range, and pictures of both side by side, real ones on the left. Real pictures are read
/// again from their files; a set that is only numbers shows none. Throws Error for pictures that
/// cannot be read.
std::string realism_page(const PictureSet& real, const std::vector<RealismEntry>& entries);

}  // namespace vinebench::harness
