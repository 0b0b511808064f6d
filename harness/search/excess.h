// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "harness/judge/expectations.h"
#include "harness/report/stored_run.h"

namespace vinebench::harness {

/// How far a run is beyond the worst of its bounds: the binary logarithm of measured over allowed,
/// or of its inverse for a minimum, 1 for twice the error. Positive if one is broken, else 0 at
/// most. Counts and shares that hold are -1, for they do not come near their bound gradually; what
/// was not measured counts as 4. `only` is the key of one bound, or empty for all. What asks for a
/// certain scene (`blind`) or for several runs (`median`) is left out.
double excess_of(const StoredRun& run, const Expectations& expectations, const Expectations& goal,
                 const std::string& only);

/// Throws Error, with the nearest key, unless one of the two asks for it.
void check_bound(const std::string& key, const Expectations& expectations,
                 const Expectations& goal);

}  // namespace vinebench::harness
