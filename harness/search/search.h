// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "harness/search/find_failure.h"
#include "harness/search/search_runs.h"

namespace vinebench::harness {

/// What one seed says of a counter-example.
struct SeedProof {
  std::int64_t seed = 0;
  Answer system;
  /// Of the reference; without one, of the system without the difficulties; empty where there are
  /// none either.
  std::optional<Answer> other{};

  bool holds() const;
};

struct CounterExample {
  Condition found;               ///< by the search, before it was shrunk
  std::size_t runs_to_find = 0;  ///< that it took
  Condition condition;
  std::vector<SeedProof> proof;  ///< with seeds that were not searched with
  std::size_t wanted = 0;        ///< seeds of the proof
  /// Seeds that did not agree on conditions that were tried before this one.
  std::vector<std::pair<Condition, SeedProof>> disagreed{};

  std::size_t agreeing() const;
  bool is_proven() const { return wanted > 0 && agreeing() == wanted; }
};

struct SearchSettings {
  std::vector<std::int64_t> seeds;  ///< that are searched and shrunk with
  std::size_t proof_seeds = 20;
  std::int64_t first_proof_seed = 101;
  std::size_t at_once = 1;  ///< runs side by side
  /// Searches at random, with this draw, as far as the budget has more than shrinking and proof
  /// need.
  std::optional<std::uint64_t> random{};
};

/// Finds a failure, shrinks it and proves it with other seeds. Where the system passes with one of
/// them, the severities grow by a step; where the reference fails too, the last step of shrinking
/// is taken back; and new seeds are asked, while the budget lasts. What other seeds do not bear out
/// is dismissed, and the search goes on among other difficulties. Empty if nothing is found; what
/// most seeds bear out where nothing is proven.
std::optional<CounterExample> search(SearchRuns& runs, const SearchSettings& settings,
                                     const Tell& tell);

}  // namespace vinebench::harness
