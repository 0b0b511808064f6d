// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "harness/search/find_failure.h"
#include "harness/search/search_runs.h"

namespace vinebench::harness {

/// Makes a condition that breaks the system smaller as long as it does, in the manner of a reducer
/// of a compiler's tests (Zeller and Hildebrandt 2002, IEEE Trans. Softw. Eng. 28:183): fewer
/// difficulties, then a shorter route (an earlier end, a later start, then whole seconds less). It
/// goes by the first seed, and keeps a step only if all of `seeds` say the same; where the seeds
/// differ about the condition itself, its severities grow until they agree. Without a reference
/// the system must pass the shorter route under no difficulty, so that a route on which the bounds
/// cannot be met is none. Returns the steps that were kept, of which the last one is the smallest.
std::vector<Condition> shrink(SearchRuns& runs, const Condition& condition,
                              const std::vector<std::int64_t>& seeds, const Tell& tell);

/// The same, more severe by a step in each of its difficulties; at the worst it stays.
Condition harder(const Condition& condition);

/// The condition without its difficulties.
Condition plain_of(const Condition& condition);

}  // namespace vinebench::harness
