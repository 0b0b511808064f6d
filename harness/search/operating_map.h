// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/search/find_failure.h"
#include "harness/search/search_runs.h"

namespace vinebench::harness {

/// Where in the plane of two difficulties a system passes.
struct OperatingMap {
  struct Cell {
    double across = 0;  ///< severity
    double up = 0;      ///< likewise
    int runs = 0;       ///< with a verdict
    int passed = 0;     ///< of these
    bool impossible = false;
  };
  std::size_t across = 0;   ///< difficulty
  std::size_t up = 0;       ///< likewise
  std::size_t size = 0;     ///< cells along each
  std::vector<Cell> cells;  ///< row by row, from mild to severe

  const Cell& at(std::size_t x, std::size_t y) const { return cells[y * size + x]; }
};

/// Runs the lattice of size x size severities with the first seed, then those cells with all seeds
/// that have a neighbour of another verdict: that is where it is not sure. Throws Error if both
/// difficulties are the same.
OperatingMap map_envelope(SearchRuns& runs, std::size_t across, std::size_t up, std::size_t size,
                          const std::vector<std::int64_t>& seeds, const Tell& tell);

/// The runs of the lattice.
std::vector<Query> lattice_queries(const SearchProblem& problem, std::size_t across, std::size_t up,
                                   std::size_t size, std::int64_t seed);

/// A table with the interval of each cell's rate of passing (95 %, Clopper and Pearson), as CSV.
std::string map_csv(const OperatingMap& map, const SearchSpace& space);

/// A picture: green where it passes, red where it fails, pale where few runs tell, with the counts.
std::string map_svg(const OperatingMap& map, const SearchSpace& space, const std::string& title);

}  // namespace vinebench::harness
