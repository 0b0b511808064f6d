// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/explain/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <opencv2/core/utility.hpp>

#include "core/util/error.h"
#include "harness/explain/run_repeater.h"

namespace vinebench::harness {
namespace {

constexpr std::size_t kFactorsInPairs = 5;
constexpr int kRounds = 4;  // of repeats

void check_can_be_repeated(const ExplainRequest& request) {
  const ScenarioConfig& scenario = request.scenario;
  if (!scenario.slam.is_core()) {
    fail("{}: explain needs the built-in SLAM core, found another SLAM system", scenario.name);
  }
  if (scenario.simulation.route.steering == sim::Steering::kEstimate) {
    fail("{}: explain needs route.steering: truth, found estimate", scenario.name);
  }
  if (scenario.earlier_visit) {
    fail("{}: explain needs a run that begins without a map, found earlier_visit", scenario.name);
  }
  if (request.placebos < 2) fail("expected at least two placebos, found {}", request.placebos);
}

/// The larger share of drift and of lost frames that an effect causes.
double caused_share(const AsItWas& was, const Effect& effect) {
  double most = 0;
  if (effect.drift_is_caused) most = effect.metres / was.metres.typical();
  if (effect.losses_are_caused) most = std::max(most, effect.lost / was.lost.typical());
  return most;
}

/// Of causes, by factor: the share, and where those are equal (all frames come back without either)
/// by how much less the drive drifts, m.
using Shares = std::map<std::size_t, std::pair<double, double>>;

void add_causes(const AsItWas& was, const std::vector<FactorEffect>& effects, Shares& shares) {
  for (const FactorEffect& one : effects) {
    if (!one.effect.is_cause()) continue;
    shares[one.factors[0]] = {caused_share(was, one.effect), one.effect.metres};
  }
}

std::vector<std::size_t> by_share(const Shares& shares) {
  std::vector<std::size_t> causes;
  for (const auto& [factor, ignored] : shares) causes.push_back(factor);
  std::ranges::stable_sort(causes, std::greater(), [&](std::size_t i) { return shares.at(i); });
  return causes;
}

/// Reruns, and how they are judged against others that differ in the noise alone.
struct Comparison {
  Normal& normal;
  std::function<Effect(const std::vector<StretchDrift>&)> effect;
  std::vector<Job> jobs;
  int rounds = kRounds;  ///< of repeats at most
};

/// Repeats a run and parts of it.
class Explainer {
 public:
  explicit Explainer(const ExplainRequest& request)
      : request_(request),
        rate_hz_(load_rig(request.scenario.simulation.rover.rig).rate_hz),
        runs_(request, last_start(), last_frame()) {
    result_.factors = factors_of(request.scenario);
  }

  Explanation run() {
    for (const Stretch& stretch : request_.stretches) {
      runs_.advance_to(start_of(stretch));
      result_.stretches.push_back(explain_stretch(stretch));
    }
    result_.reruns = runs_.reruns();
    result_.rerun_seconds = runs_.seconds();
    return result_;
  }

 private:
  /// Index of the first frame without a factor.
  std::int64_t start_of(const Stretch& stretch) const {
    const auto lead = static_cast<std::int64_t>(std::ceil(request_.lead * rate_hz_));
    return std::max<std::int64_t>(0, stretch.first - lead);
  }

  std::int64_t last_start() const {
    std::int64_t last = 0;
    for (const Stretch& stretch : request_.stretches) last = std::max(last, start_of(stretch));
    return last;
  }

  std::int64_t last_frame() const {
    std::int64_t last = 0;
    for (const Stretch& stretch : request_.stretches) last = std::max(last, stretch.last);
    return last;
  }

  StretchDrift drift(const Rerun& rerun, const StretchExplanation& explanation) const {
    return runs_.drift(rerun, explanation.stretch, explanation.aligned);
  }

  Job without(const std::vector<std::size_t>& factors) const {
    Job job{.name = "without", .variant = runs_.original(), .factors = factors};
    for (const std::size_t i : factors) {
      const Factor& factor = result_.factors[i];
      factor.remove(job.variant);
      job.from_start = job.from_start || factor.from_start;
      job.name += " " + factor.name;
    }
    return job;
  }

  StretchExplanation explain_stretch(const Stretch& stretch) {
    StretchExplanation explanation{.stretch = stretch};
    explanation.aligned = std::max<std::int64_t>(0, runs_.next() - 1);
    Look look;
    measure_chance(explanation, look.normal);
    try_singles(explanation, look);
    try_all(explanation, look);
    try_pairs(explanation, look);
    while (true) {
      look.causes = causes_of(look);
      if (look.causes.empty()) try_alone(explanation, look);
      explanation.looks.push_back(std::move(look));
      if (!leaves_something(explanation, look)) return explanation;
      try_singles(explanation, look);
    }
  }

  /// The run itself, which must be the same, and placebos.
  void measure_chance(StretchExplanation& explanation, Normal& normal) {
    std::vector<Job> itself{{.name = "as it was", .variant = runs_.original()}};
    const Rerun rerun = runs_.make(itself, explanation.stretch.last)[0];
    std::ranges::for_each(rerun.steps, [&](const Step& step) { runs_.known().check(step); });
    if (rerun.steps.empty()) fail("the drive ends before frame {}", runs_.next());
    explanation.was = drift(rerun, explanation);
    normal.drifts = {explanation.was};
    result_.null_seconds += rerun.seconds / static_cast<double>(request_.stretches.size());
    add_placebos(explanation, normal, request_.placebos);
  }

  /// Those that are missing to `count`, beside the first one.
  void add_placebos(const StretchExplanation& explanation, Normal& normal, int count) {
    const Job plain = without(normal.without);
    std::vector<Job> jobs;
    for (int number = static_cast<int>(normal.drifts.size()); number <= count; ++number) {
      jobs.push_back(plain);
      jobs.back().name = normal.without.empty() ? fmt::format("placebo {}", number)
                                                : fmt::format("{}, again {}", plain.name, number);
      jobs.back().variant = with_other_noise(plain.variant, number);
    }
    for (const Rerun& rerun : runs_.make(jobs, explanation.stretch.last)) {
      normal.drifts.push_back(drift(rerun, explanation));
    }
    normal.chance = as_it_was(normal.drifts);
  }

  std::vector<FactorEffect> effects(Comparison& comparison, const StretchExplanation& explanation) {
    std::vector<FactorEffect> list(comparison.jobs.size());
    const std::vector<Rerun> reruns = runs_.make(comparison.jobs, explanation.stretch.last);
    for (std::size_t i = 0; i < list.size(); ++i) {
      list[i].factors = comparison.jobs[i].factors;
      list[i].from_start = comparison.jobs[i].from_start;
      list[i].reruns.push_back(drift(reruns[i], explanation));
    }
    judge(comparison, list);
    for (int round = 0; request_.repeats > 0 && round < comparison.rounds; ++round) {
      if (std::ranges::none_of(list, is_open)) break;
      add_placebos(explanation, comparison.normal, (2 + round / 2) * request_.placebos);
      repeat(comparison, explanation, list);
    }
    return list;
  }

  static bool is_open(const FactorEffect& one) { return one.effect.is_open; }

  /// Those that are open, with other noise; all are judged again.
  void repeat(const Comparison& comparison, const StretchExplanation& explanation,
              std::vector<FactorEffect>& list) {
    std::vector<Job> again;
    std::vector<std::size_t> of;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Job& job = comparison.jobs[i];
      for (int k = 0; list[i].effect.is_open && k < request_.repeats; ++k) {
        const int number = static_cast<int>(list[i].reruns.size()) + k;
        again.push_back(job);
        again.back().name += fmt::format(", again {}", number);
        again.back().variant = with_other_noise(job.variant, number);
        of.push_back(i);
      }
    }
    const std::vector<Rerun> reruns = runs_.make(again, explanation.stretch.last);
    for (std::size_t i = 0; i < again.size(); ++i) {
      list[of[i]].reruns.push_back(drift(reruns[i], explanation));
    }
    judge(comparison, list);
  }

  static void judge(const Comparison& comparison, std::vector<FactorEffect>& list) {
    for (FactorEffect& one : list) one.effect = comparison.effect(one.reruns);
  }

  /// How much less there is than normally.
  static Comparison less_than(Normal& normal) {
    return {.normal = normal,
            .effect =
                [&normal](const std::vector<StretchDrift>& reruns) {
                  return effect_of(normal.chance, reruns);
                },
            .jobs = {}};
  }

  std::vector<std::size_t> all_factors() const {
    std::vector<std::size_t> all(result_.factors.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }

  /// Each factor that is not absent already.
  std::vector<std::size_t> present_factors(const Normal& normal) const {
    std::vector<std::size_t> present = all_factors();
    std::erase_if(present,
                  [&](std::size_t i) { return std::ranges::count(normal.without, i) > 0; });
    return present;
  }

  void try_singles(const StretchExplanation& explanation, Look& look) {
    const std::vector<std::size_t> present = present_factors(look.normal);
    Comparison comparison = less_than(look.normal);
    for (const std::size_t i : present) {
      std::vector<std::size_t> one_more = look.normal.without;
      one_more.push_back(i);
      comparison.jobs.push_back(without(one_more));
    }
    look.singles = effects(comparison, explanation);
    for (FactorEffect& single : look.singles) single.factors = {single.factors.back()};
  }

  void try_all(StretchExplanation& explanation, Look& look) {
    if (look.singles.size() == 1) explanation.all = look.singles[0];
    if (look.singles.size() < 2) return;
    Comparison comparison = less_than(look.normal);
    comparison.jobs = {without(all_factors())};
    explanation.all = effects(comparison, explanation)[0];
    judge(comparison, look.singles);  // there may be more placebos by now
  }

  /// Where a look has no cause and all that is left of the factors together has an effect: those
  /// of them that would do alone.
  void try_alone(const StretchExplanation& explanation, Look& look) {
    const std::vector<std::size_t> present = present_factors(look.normal);
    if (present.size() < 2) return;
    const Effect all = effect_of(look.normal.chance, explanation.all->reruns);
    if (!all.is_cause()) return;
    look.nothing = {.without = all_factors(), .drifts = explanation.all->reruns};
    add_placebos(explanation, look.nothing, request_.placebos);
    Comparison comparison{.normal = look.nothing,
                          .effect =
                              [&](const std::vector<StretchDrift>& reruns) {
                                return effect_alone(look.nothing.chance, reruns, look.normal.chance,
                                                    all);
                              },
                          .jobs = {}};
    for (const std::size_t i : present) {
      std::vector<std::size_t> others = all_factors();
      std::erase(others, i);
      comparison.jobs.push_back(without(others));
    }
    look.alone = effects(comparison, explanation);
    for (std::size_t i = 0; i < present.size(); ++i) look.alone[i].factors = {present[i]};
    look.causes = causes_of(look);
  }

  /// The stretch without the causes found so far becomes the normal one of the next look, if it is
  /// worse than without any factor. False if there is nothing more to find.
  bool leaves_something(const StretchExplanation& explanation, Look& next) {
    const std::vector<std::size_t> found = explanation.causes();
    if (explanation.looks.back().causes.empty() || found.size() == result_.factors.size()) {
      return false;
    }
    next = {.normal = {.without = found, .drifts = reruns_without(found, explanation)}};
    if (!leaves_more(next.normal.drifts, explanation.all->reruns)) return false;
    add_placebos(explanation, next.normal, request_.placebos);
    return true;
  }

  /// Those that were made already, or one that is made now.
  std::vector<StretchDrift> reruns_without(const std::vector<std::size_t>& factors,
                                           const StretchExplanation& explanation) {
    if (factors.size() == 1) return explanation.looks[0].singles[factors[0]].reruns;
    std::vector<Job> jobs{without(factors)};
    return {drift(runs_.make(jobs, explanation.stretch.last)[0], explanation)};
  }

  void try_pairs(StretchExplanation& explanation, Look& look) {
    if (look.singles.size() < 2) return;
    std::vector<Effect> singles;
    for (const FactorEffect& single : look.singles) singles.push_back(single.effect);
    if (!do_not_add_up(look.normal.chance, singles, explanation.all->effect)) return;
    std::vector<std::size_t> order = all_factors();
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) {
      return std::abs(singles[i].metres) + 0.01 * std::abs(singles[i].lost);
    });
    order.resize(std::min(order.size(), kFactorsInPairs));
    Comparison comparison = less_than(look.normal);
    comparison.rounds = 0;
    for (std::size_t b = 1; b < order.size(); ++b) {
      for (std::size_t a = 0; a < b; ++a) {
        if (comparison.jobs.size() >= static_cast<std::size_t>(request_.pairs)) continue;
        comparison.jobs.push_back(without({order[a], order[b]}));
      }
    }
    explanation.pairs = effects(comparison, explanation);
    for (FactorEffect& pair : explanation.pairs) {
      pair.interaction =
          interaction_of(singles[pair.factors[0]], singles[pair.factors[1]], pair.effect);
    }
  }

  const ExplainRequest& request_;
  double rate_hz_;
  RunRepeater runs_;
  Explanation result_;
};

}  // namespace

Explanation explain(const ExplainRequest& request) {
  check_can_be_repeated(request);
  cv::setNumThreads(1);  // threads would be missing in a forked process
  return Explainer(request).run();
}

std::vector<std::size_t> causes_of(const Look& look) {
  Shares shares;
  add_causes(look.normal.chance, look.singles, shares);
  add_causes(look.normal.chance, look.alone, shares);
  return by_share(shares);
}

std::vector<std::size_t> StretchExplanation::causes() const {
  std::vector<std::size_t> causes;
  for (const Look& look : looks) {
    causes.insert(causes.end(), look.causes.begin(), look.causes.end());
  }
  return causes;
}

}  // namespace vinebench::harness
