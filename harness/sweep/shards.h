// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace vinebench::harness {

/// One of several parts of a sweep, counted from 1.
struct Shard {
  int index = 1;
  int count = 1;
};

/// Parses "3/16". Throws Error for anything else, and for a shard beyond the last.
Shard parse_shard(const std::string& text);

/// Which of the tasks belong to the shard, the most expensive first: each task, in the order of
/// their costs, goes to the shard that has least so far (Graham, "Bounds on multiprocessing timing
/// anomalies", 1969: at most 4/3 of the best there is). Depends on the costs alone.
std::vector<std::size_t> tasks_of(const Shard& shard, const std::vector<double>& costs);

}  // namespace vinebench::harness
