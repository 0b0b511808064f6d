// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "harness/search/search_runs.h"

namespace vinebench::harness {

/// Gets a line on what was found, for whoever waits.
using Tell = std::function<void(const std::string&)>;

/// Whether the system fails there, and the reference, if there is one, does not. The reference is
/// asked where the system fails alone.
bool breaks(SearchRuns& runs, const Condition& condition, std::int64_t seed);

/// The mildest condition that breaks the system with this seed: the one of fewest difficulties and
/// then the least sum of severities, as far as the budget reaches.
///
///  1. the scenario as it is;
///  2. each difficulty alone at its worst; where the system fails and the reference does not, its
///     severity is halved to 1/16;
///  3. each pair of them, each at the worst that the system stands alone; on the way there the
///     point is looked for at which the system begins to fail, by halving both, or by minimise()
///     where the reference fails there too; then each is halved;
///  4. all together, by minimise() over the excess.
///
/// One or two difficulties that are `dismissed` together are passed over, in 2 and 3. Empty if none
/// is found. Throws Error if the reference fails in the scenario as it is.
std::optional<Condition> find_failure(SearchRuns& runs, std::int64_t seed, const Tell& tell,
                                      const std::vector<Condition>& dismissed = {});

/// For comparison, at random: one or two difficulties of any severity, until a condition that
/// breaks the system has `difficulties` at most and a sum of severities of `severity` at most; the
/// mildest so far where no more than `reserve` runs of the budget are left before. The draws depend
/// on `draw` and the number of difficulties alone.
std::optional<Condition> find_at_random(SearchRuns& runs, std::int64_t seed, std::uint64_t draw,
                                        int difficulties, double severity, std::size_t reserve = 0);

/// The runs whose answers find_failure() asks for whatever they are: parts of them can be made
/// elsewhere before.
std::vector<Query> first_queries(const SearchProblem& problem, std::int64_t seed);

/// Fewer difficulties, then less severity.
bool is_milder(const Condition& a, const Condition& b);

}  // namespace vinebench::harness
