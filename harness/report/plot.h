// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "harness/judge/results.h"

namespace vinebench::harness {

/// Top view of the run as SVG: rows, posts, boxes and tags of the world, the true path, and the
/// corrected estimate (SE(3)-aligned) coloured by its distance from the truth.
std::string plot_svg(const Trial& trial, const RunRecord& record, const RunResults& results);

}  // namespace vinebench::harness
