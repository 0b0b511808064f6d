// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "harness/search/search.h"

namespace vinebench::harness {

/// The counter-example as a scenario of its own, with a comment on where it comes from: without
/// settings of the system that fails in it, which is whatever it is run with. It expects what the
/// searched one does.
std::string counter_example_yaml(const SearchRuns& runs, const CounterExample& example);

/// What was found, how it was shrunk and what the other seeds say, in Markdown.
std::string search_report(const SearchRuns& runs, const CounterExample& example);

/// Every answer in the order in which it was asked for first, with all severities, as CSV.
std::string search_csv(const SearchRuns& runs);

}  // namespace vinebench::harness
