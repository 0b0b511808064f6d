// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

namespace vinebench::harness {

/// Looks for the least value of a function over the box from 0 to `upper`, in `evaluations` of it,
/// by dividing rectangles (DIRECT-L: Gablonsky and Kelley 2001, J. Global Optim. 21:27, as NLopt
/// has it): needs no derivative, starts at the middle, and draws nothing at random. The function
/// keeps what it sees; what it throws is passed on. Throws Error if NLopt fails.
void minimise(const std::function<double(const std::vector<double>&)>& function,
              const std::vector<double>& upper, int evaluations);

}  // namespace vinebench::harness
