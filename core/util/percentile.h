// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace vinebench {

/// Quantile for `share` (0 to 1), linearly interpolated. Requires at least one sample.
double percentile(std::vector<double> samples, double share);

}  // namespace vinebench
