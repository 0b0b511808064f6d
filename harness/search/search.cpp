// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/search/search.h"

#include <fmt/format.h>

#include <algorithm>

#include "harness/search/shrink.h"

namespace vinebench::harness {
namespace {

constexpr std::size_t kShrinkingRuns = 30;  // that a search at random leaves for it
constexpr int kProofs = 4;                  // that are tried, each with seeds of its own

std::vector<SeedProof> ask_seeds(SearchRuns& runs, const Condition& condition,
                                 const std::vector<std::int64_t>& seeds) {
  const bool has_reference = runs.problem().reference.has_value();
  const bool has_other = has_reference || condition.difficulties() > 0;
  std::vector<Query> queries;
  for (const std::int64_t seed : seeds) {
    queries.push_back({condition, Role::kSystem, seed});
    if (has_reference) {
      queries.push_back({condition, Role::kReference, seed});
    } else if (has_other) {
      queries.push_back({plain_of(condition), Role::kSystem, seed});
    }
  }
  const std::vector<Answer> answers = runs.ask(queries);
  std::vector<SeedProof> proof;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    if (has_other) {
      proof.push_back({seeds[i], answers[2 * i], answers[2 * i + 1]});
    } else {
      proof.push_back({seeds[i], answers[i], std::nullopt});
    }
  }
  return proof;
}

/// Seed after seed, as many as run side by side; until one does not agree, if `stop`.
std::vector<SeedProof> prove(SearchRuns& runs, const Condition& condition, std::int64_t first,
                             const SearchSettings& settings, bool stop) {
  std::vector<SeedProof> proof;
  while (proof.size() < settings.proof_seeds && runs.left() > 0 && !runs.interrupted()) {
    std::vector<std::int64_t> seeds;
    const std::size_t count = std::min(settings.at_once, settings.proof_seeds - proof.size());
    for (std::size_t k = 0; k < count; ++k) {
      seeds.push_back(first + static_cast<std::int64_t>(proof.size() + k));
    }
    const std::vector<SeedProof> more = ask_seeds(runs, condition, seeds);
    proof.insert(proof.end(), more.begin(), more.end());
    if (stop && !std::ranges::all_of(proof, &SeedProof::holds)) break;
  }
  return proof;
}

/// A seed with which the system fails and what it is compared with does too.
bool is_too_hard(const std::vector<SeedProof>& proof) {
  return std::ranges::any_of(proof, [](const SeedProof& seed) {
    return seed.system.verdict == RunVerdict::kFailed && !seed.holds();
  });
}

/// Where seeds do not agree, with more severity if the system passes, and with the step of
/// shrinking before if the others fail too.
void prove(SearchRuns& runs, std::vector<Condition> steps, CounterExample& example,
           const SearchSettings& settings, const Tell& tell) {
  example.wanted = settings.proof_seeds;
  std::int64_t first = settings.first_proof_seed;
  for (int k = 1; k <= kProofs && settings.proof_seeds > 0; ++k) {
    example.condition = steps.back();
    const bool last = k == kProofs || runs.left() < 4 * settings.proof_seeds;
    example.proof = prove(runs, example.condition, first, settings, !last);
    tell(fmt::format("{}: proven by {} of {} other seeds",
                     text_of(runs.problem().space, example.condition.severities),
                     example.agreeing(), example.proof.size()));
    if (last || example.is_proven() || runs.interrupted()) return;
    for (const SeedProof& seed : example.proof) {
      if (!seed.holds()) example.disagreed.emplace_back(example.condition, seed);
    }
    if (!is_too_hard(example.proof)) {
      const Condition harsher = harder(example.condition);
      if (harsher == example.condition) return;
      steps.back() = harsher;
    } else if (steps.size() > 1) {
      steps.pop_back();
    } else {
      return;
    }
    first += static_cast<std::int64_t>(settings.proof_seeds);
  }
}

}  // namespace

bool SeedProof::holds() const {
  return system.verdict == RunVerdict::kFailed && (!other || other->verdict == RunVerdict::kPassed);
}

std::size_t CounterExample::agreeing() const {
  return static_cast<std::size_t>(std::ranges::count_if(proof, &SeedProof::holds));
}

std::optional<CounterExample> search(SearchRuns& runs, const SearchSettings& settings,
                                     const Tell& tell) {
  SearchSettings now = settings;
  const std::int64_t seed = settings.seeds.front();
  const std::size_t reserve = 2 * settings.proof_seeds + kShrinkingRuns;
  std::optional<CounterExample> best;
  std::vector<Condition> dismissed;
  while (true) {
    const std::optional<Condition> found =
        settings.random ? find_at_random(runs, seed, *settings.random, 0, 0, reserve)
                        : find_failure(runs, seed, tell, dismissed);
    if (!found || runs.interrupted()) return best;
    CounterExample example{*found, runs.count(), *found, {}};
    tell(fmt::format("breaks under {}, after {} runs",
                     text_of(runs.problem().space, found->severities), runs.count()));
    prove(runs, shrink(runs, *found, settings.seeds, tell), example, now, tell);
    if (!best || best->agreeing() < example.agreeing()) best = example;
    if (best->is_proven() || settings.random || settings.proof_seeds == 0 ||
        found->difficulties() == 0 || runs.left() < reserve || runs.interrupted()) {
      return best;
    }
    // By chance with these seeds.
    dismissed.push_back(*found);
    now.first_proof_seed += kProofs * static_cast<std::int64_t>(settings.proof_seeds);
    tell("other seeds do not bear that out: looking for something else");
  }
}

}  // namespace vinebench::harness
