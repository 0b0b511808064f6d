// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/search/find_failure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/util/error.h"
#include "core/util/random.h"
#include "harness/search/minimise.h"

namespace vinebench::harness {
namespace {

constexpr double kFinest = 1.0 / 16;  // severity to which halving goes
constexpr int kPairEvaluations = 17;  // of the optimiser, in a pair: three divisions of the box
constexpr std::size_t kPairs = 2;     // that are looked into
constexpr int kAllEvaluations = 100;  // of the optimiser, over all difficulties
constexpr int kDraws = 100000;        // at random, also of conditions that cannot be

double rounded(double severity) {
  return std::round(severity / kSeverityStep) * kSeverityStep;
}

bool have_same_difficulties(const Condition& a, const Condition& b) {
  return std::ranges::equal(a.severities, b.severities,
                            [](double x, double y) { return (x > 0) == (y > 0); });
}

class Guided {
 public:
  Guided(SearchRuns& runs, std::int64_t seed, const Tell& tell,
         const std::vector<Condition>& dismissed)
      : runs_(runs),
        seed_(seed),
        tell_(tell),
        dismissed_(dismissed),
        size_(runs.problem().space.difficulties.size()) {}

  std::optional<Condition> find() {
    const Condition plain{Severities(size_)};
    const bool fails = failed(plain);
    if (runs_.problem().reference) {
      const Answer reference = runs_.ask({plain, Role::kReference, seed_});
      if (reference.verdict == RunVerdict::kUnknown) return std::nullopt;
      if (reference.verdict != RunVerdict::kPassed) {
        fail("the reference does not pass the scenario as it is: {}", reference.why);
      }
    }
    if (fails) return plain;
    for (const auto& stage : {&Guided::singles, &Guided::pairs, &Guided::all}) {
      if (std::optional<Condition> found = (this->*stage)()) return found;
    }
    return std::nullopt;
  }

 private:
  bool failed(const Condition& condition) {
    return runs_.ask({condition, Role::kSystem, seed_}).verdict == RunVerdict::kFailed;
  }

  Condition at(const std::vector<std::pair<std::size_t, double>>& severities) const {
    Condition condition{Severities(size_)};
    for (const auto& [i, severity] : severities) condition.severities[i] = severity;
    return condition;
  }

  /// Verdicts of the system, side by side.
  std::vector<Answer> ask_all(const std::vector<Condition>& conditions, Role role) {
    std::vector<Query> queries;
    for (const Condition& condition : conditions) queries.push_back({condition, role, seed_});
    return runs_.ask(queries);
  }

  /// Those that break the system; the reference is asked about those alone.
  std::vector<Condition> breaking(const std::vector<Condition>& conditions,
                                  std::vector<Condition>* fail_in_both = nullptr) {
    const std::vector<Answer> answers = ask_all(conditions, Role::kSystem);
    std::vector<Condition> failing;
    for (std::size_t i = 0; i < conditions.size(); ++i) {
      if (answers[i].verdict == RunVerdict::kFailed) failing.push_back(conditions[i]);
    }
    if (!runs_.problem().reference) return failing;
    const std::vector<Answer> references = ask_all(failing, Role::kReference);
    std::vector<Condition> found;
    for (std::size_t i = 0; i < failing.size(); ++i) {
      if (references[i].verdict == RunVerdict::kPassed) {
        found.push_back(failing[i]);
      } else if (fail_in_both != nullptr) {
        fail_in_both->push_back(failing[i]);
      }
    }
    return found;
  }

  /// The least severity of one of a condition's difficulties with which it still breaks the system,
  /// or with which that fails at least, where the reference fails too.
  Condition halve(Condition condition, std::size_t i, bool alone = true) {
    double low = 0;
    for (double high = condition.severities[i]; high - low > kFinest;) {
      const double middle = rounded((low + high) / 2);
      Condition milder = condition;
      milder.severities[i] = middle;
      if (alone ? breaks(runs_, milder, seed_) : failed(milder)) {
        condition = milder;
        high = middle;
      } else {
        low = middle;
      }
    }
    if (condition.difficulties() == 1) stands_[i] = low;
    return condition;
  }

  /// Those of other difficulties than any that is dismissed.
  std::vector<Condition> left_of(std::vector<Condition> conditions) const {
    std::erase_if(conditions, [&](const Condition& condition) {
      return std::ranges::any_of(dismissed_, [&](const Condition& dismissed) {
        return have_same_difficulties(condition, dismissed);
      });
    });
    return conditions;
  }

  std::optional<Condition> mildest(const std::vector<Condition>& conditions) {
    std::vector<Condition> found = breaking(left_of(conditions));
    if (found.empty()) return std::nullopt;
    return *std::ranges::min_element(found, is_milder);
  }

  std::optional<Condition> singles() {
    std::vector<Condition> worst;
    for (std::size_t i = 0; i < size_; ++i) worst.push_back(at({{i, 1.0}}));
    std::vector<Condition> in_both;
    const std::vector<Condition> found = breaking(worst, &in_both);
    tell_(fmt::format("one difficulty at its worst: {} break the system", found.size()));
    stands_.assign(size_, 1);
    if (std::optional<Condition> condition = mildest(halved(found, true))) return condition;
    // Where both fail at the worst there may be less with which one does alone.
    return mildest(halved(in_both, false));
  }

  std::vector<Condition> halved(const std::vector<Condition>& conditions, bool alone) {
    std::vector<Condition> milder;
    for (const Condition& condition : conditions) {
      const auto hard = std::ranges::find_if(condition.severities, [](double s) { return s > 0; });
      const auto i = static_cast<std::size_t>(hard - condition.severities.begin());
      milder.push_back(halve(condition, i, alone));
    }
    return milder;
  }

  std::optional<Condition> pairs() {
    std::vector<Condition> worst;
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t j = i + 1; j < size_; ++j) {
        if (stands_[i] > 0 && stands_[j] > 0)
          worst.push_back(at({{i, stands_[i]}, {j, stands_[j]}}));
      }
    }
    std::vector<Condition> in_both;
    const std::vector<Condition> found = breaking(worst, &in_both);
    tell_(fmt::format("two difficulties at the worst that each is stood alone: {} break the system",
                      found.size()));
    if (std::optional<Condition> condition = mildest_of_pairs(left_of(found))) return condition;
    // Where both fail at the worst there may be less with which one does alone.
    return mildest_of_pairs(left_of(in_both));
  }

  /// Of the first ones.
  std::optional<Condition> mildest_of_pairs(const std::vector<Condition>& pairs) {
    std::vector<Condition> milder;
    for (std::size_t k = 0; k < std::min(pairs.size(), kPairs); ++k) {
      milder.push_back(mildest_of_pair(pairs[k]));
    }
    return mildest(milder);
  }

  /// The mildest condition on the line from no difficulty to this one with which the system fails.
  Condition halve_all(const Condition& worst) {
    Condition condition = worst;
    double low = 0;
    for (double high = 1; high - low > kFinest;) {
      const double middle = (low + high) / 2;
      Condition milder = worst;
      for (double& severity : milder.severities) severity = rounded(middle * severity);
      if (failed(milder)) {
        condition = milder;
        high = middle;
      } else {
        low = middle;
      }
    }
    return condition;
  }

  /// Both severities change at once, then each alone. Where the system begins to fail on the way to
  /// the worst the reference mostly passes; else the optimiser looks for where it does.
  Condition mildest_of_pair(const Condition& pair) {
    std::vector<std::size_t> hard;
    std::vector<double> upper;
    for (std::size_t i = 0; i < size_; ++i) {
      if (pair.severities[i] <= 0) continue;
      hard.push_back(i);
      upper.push_back(pair.severities[i]);
    }
    Condition best = halve_all(pair);
    if (!breaks(runs_, best, seed_)) {
      best = search_box(pair, hard, upper, kPairEvaluations).value_or(pair);
    }
    for (const std::size_t i : hard) best = halve(best, i);
    return best;
  }

  /// The mildest condition in the box that the optimiser meets and that breaks the system: its
  /// severities where it does, above them by what is left to the bound where it does not.
  std::optional<Condition> search_box(const Condition& around, const std::vector<std::size_t>& free,
                                      const std::vector<double>& upper, int evaluations) {
    std::optional<Condition> best;
    const auto value = [&](const std::vector<double>& severities) {
      Condition condition = around;
      for (std::size_t k = 0; k < free.size(); ++k) {
        condition.severities[free[k]] = rounded(severities[k]);
      }
      if (breaks(runs_, condition, seed_)) {
        if (!best || is_milder(condition, *best)) best = condition;
        return condition.severity();
      }
      const Answer answer = runs_.ask({condition, Role::kSystem, seed_});
      return static_cast<double>(size_) +
             (answer.verdict == RunVerdict::kPassed ? -answer.excess : 0);
    };
    minimise(value, upper, evaluations);
    return best;
  }

  std::optional<Condition> all() {
    std::vector<std::size_t> free(size_);
    for (std::size_t i = 0; i < size_; ++i) free[i] = i;
    tell_("no two of them break it; looking among all together");
    return search_box(at({}), free, stands_, kAllEvaluations);
  }

  SearchRuns& runs_;
  std::int64_t seed_;
  const Tell& tell_;
  const std::vector<Condition>& dismissed_;
  std::size_t size_;
  std::vector<double> stands_{};  ///< the worst severity of each alone with which the system passes
};

}  // namespace

bool is_milder(const Condition& a, const Condition& b) {
  return std::pair(a.difficulties(), a.severity()) < std::pair(b.difficulties(), b.severity());
}

bool breaks(SearchRuns& runs, const Condition& condition, std::int64_t seed) {
  if (runs.ask({condition, Role::kSystem, seed}).verdict != RunVerdict::kFailed) return false;
  return !runs.problem().reference ||
         runs.ask({condition, Role::kReference, seed}).verdict == RunVerdict::kPassed;
}

std::optional<Condition> find_failure(SearchRuns& runs, std::int64_t seed, const Tell& tell,
                                      const std::vector<Condition>& dismissed) {
  return Guided(runs, seed, tell, dismissed).find();
}

std::vector<Query> first_queries(const SearchProblem& problem, std::int64_t seed) {
  const std::size_t size = problem.space.difficulties.size();
  std::vector<Query> queries{{{Severities(size)}, Role::kSystem, seed}};
  if (problem.reference) queries.push_back({{Severities(size)}, Role::kReference, seed});
  for (std::size_t i = 0; i < size; ++i) {
    Condition worst{Severities(size)};
    worst.severities[i] = 1;
    queries.push_back({worst, Role::kSystem, seed});
  }
  return queries;
}

std::optional<Condition> find_at_random(SearchRuns& runs, std::int64_t seed, std::uint64_t draw,
                                        int difficulties, double severity, std::size_t reserve) {
  RandomSequence random(RandomStream(draw, "search"));
  const int size = static_cast<int>(runs.problem().space.difficulties.size());
  std::optional<Condition> best;
  for (int k = 0; k < kDraws && runs.left() > reserve && !runs.interrupted(); ++k) {
    Condition condition{Severities(static_cast<std::size_t>(size))};
    for (int count = 1 + random.below(2); count > 0; --count) {
      condition.severities[static_cast<std::size_t>(random.below(size))] =
          std::max(kSeverityStep, rounded(random.uniform()));
    }
    if (!breaks(runs, condition, seed)) continue;
    if (!best || is_milder(condition, *best)) best = condition;
    if (best->difficulties() <= difficulties && best->severity() <= severity) break;
  }
  return best;
}

}  // namespace vinebench::harness
