// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace vinebench::harness {

/// p-values of several tests, in their order, adjusted so that rejecting those of at most alpha
/// rejects any true hypothesis with probability alpha at most, whatever their dependence (Holm
/// 1979, Scand. J. Statist. 6:65). Never less than before, at most 1.
std::vector<double> holm_adjusted(const std::vector<double>& p_values);

}  // namespace vinebench::harness
