// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/explain/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <opencv2/core/utility.hpp>

#include "core/util/error.h"
#include "harness/explain/run_repeater.h"

namespace vinebench::harness {
namespace {

constexpr std::size_t kFactorsInPairs = 5;
constexpr int kRounds = 2;  // of repeats

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

Shares shares_of(const Normal& normal, const std::vector<FactorEffect>& singles) {
  Shares shares;
  for (const FactorEffect& single : singles) {
    if (!single.effect.is_cause()) continue;
    shares[single.factors[0]] = {caused_share(normal.chance, single.effect), single.effect.metres};
  }
  return shares;
}

std::vector<std::size_t> by_share(const Shares& shares) {
  std::vector<std::size_t> causes;
  for (const auto& [factor, ignored] : shares) causes.push_back(factor);
  std::ranges::stable_sort(causes, std::greater(), [&](std::size_t i) { return shares.at(i); });
  return causes;
}

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
    measure_chance(explanation);
    std::vector<Job> jobs;
    const std::size_t count = result_.factors.size();
    for (std::size_t i = 0; i < count; ++i) jobs.push_back(without({i}));
    explanation.singles = effects(jobs, explanation, explanation.normal);
    if (count > 1) {
      std::vector<std::size_t> all(count);
      std::iota(all.begin(), all.end(), 0);
      std::vector<Job> together{without(all)};
      explanation.all = effects(together, explanation, explanation.normal)[0];
      judge(explanation.normal, explanation.singles);  // there may be more placebos by now
      try_pairs(explanation);
    }
    explanation.causes = causes_of(explanation);
    while (explain_remainder(explanation)) {
    }
    return explanation;
  }

  /// The run itself, which must be the same, and placebos.
  void measure_chance(StretchExplanation& explanation) {
    std::vector<Job> itself{{.name = "as it was", .variant = runs_.original()}};
    const Rerun rerun = runs_.make(itself, explanation.stretch.last)[0];
    std::ranges::for_each(rerun.steps, [&](const Step& step) { runs_.known().check(step); });
    if (rerun.steps.empty()) fail("the drive ends before frame {}", runs_.next());
    explanation.was = drift(rerun, explanation);
    explanation.normal.drifts = {explanation.was};
    result_.null_seconds += rerun.seconds / static_cast<double>(request_.stretches.size());
    add_placebos(explanation, explanation.normal, request_.placebos);
  }

  void add_placebos(const StretchExplanation& explanation, Normal& normal, int count) {
    const Job plain = without(normal.without);
    std::vector<Job> jobs;
    for (int i = 0; i < count; ++i) {
      const int number = static_cast<int>(normal.drifts.size()) + i;
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

  std::vector<FactorEffect> effects(std::vector<Job>& jobs, const StretchExplanation& explanation,
                                    Normal& normal, int rounds = kRounds) {
    std::vector<FactorEffect> list(jobs.size());
    add_reruns(jobs, explanation, normal, list);
    for (int round = 0; request_.repeats > 0 && round < rounds; ++round) {
      if (std::ranges::none_of(list, is_open)) break;
      if (std::ssize(normal.drifts) <= request_.placebos + 1) {
        add_placebos(explanation, normal, request_.placebos);
      }
      repeat(jobs, explanation, normal, list);
    }
    return list;
  }

  static bool is_open(const FactorEffect& one) { return one.effect.is_open; }

  /// Those that are open, with other noise; all are judged again.
  void repeat(const std::vector<Job>& jobs, const StretchExplanation& explanation,
              const Normal& normal, std::vector<FactorEffect>& list) {
    std::vector<Job> again;
    std::vector<std::size_t> of;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      for (int k = 0; list[i].effect.is_open && k < request_.repeats; ++k) {
        const int number = static_cast<int>(list[i].without.size()) + k;
        again.push_back(jobs[i]);
        again.back().name += fmt::format(", again {}", number);
        again.back().variant = with_other_noise(jobs[i].variant, number);
        of.push_back(i);
      }
    }
    const std::vector<Rerun> reruns = runs_.make(again, explanation.stretch.last);
    for (std::size_t i = 0; i < again.size(); ++i) {
      list[of[i]].without.push_back(drift(reruns[i], explanation));
    }
    judge(normal, list);
  }

  static void judge(const Normal& normal, std::vector<FactorEffect>& list) {
    for (FactorEffect& one : list) one.effect = effect_of(normal.chance, one.without);
  }

  void add_reruns(std::vector<Job>& jobs, const StretchExplanation& explanation,
                  const Normal& normal, std::vector<FactorEffect>& list) {
    const std::vector<Rerun> reruns = runs_.make(jobs, explanation.stretch.last);
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      list[i].factors = jobs[i].factors;
      list[i].from_start = jobs[i].from_start;
      list[i].without.push_back(drift(reruns[i], explanation));
    }
    judge(normal, list);
  }

  /// The stretch without the causes found so far becomes the normal one, and what makes that worse
  /// than without any factor is looked for. False if there is nothing more to find.
  bool explain_remainder(StretchExplanation& explanation) {
    const std::vector<std::size_t>& found = explanation.causes;
    if (found.empty() || found.size() == result_.factors.size()) return false;
    Remainder rest{.normal = {.without = found, .drifts = reruns_without(found, explanation)}};
    if (!leaves_more(rest.normal.drifts, explanation.all->without)) return false;
    const int missing = request_.placebos + 1 - static_cast<int>(rest.normal.drifts.size());
    add_placebos(explanation, rest.normal, std::max(0, missing));
    std::vector<Job> jobs;
    for (std::size_t i = 0; i < result_.factors.size(); ++i) {
      if (std::ranges::count(found, i) > 0) continue;
      std::vector<std::size_t> one_more = found;
      one_more.push_back(i);
      jobs.push_back(without(one_more));
    }
    rest.singles = effects(jobs, explanation, rest.normal);
    for (FactorEffect& single : rest.singles) single.factors = {single.factors.back()};
    rest.causes = by_share(shares_of(rest.normal, rest.singles));
    explanation.causes.insert(explanation.causes.end(), rest.causes.begin(), rest.causes.end());
    explanation.remainders.push_back(std::move(rest));
    return !explanation.remainders.back().causes.empty();
  }

  /// Those that were made already, or one that is made now.
  std::vector<StretchDrift> reruns_without(const std::vector<std::size_t>& factors,
                                           const StretchExplanation& explanation) {
    if (factors.size() == 1) return explanation.singles[factors[0]].without;
    std::vector<Job> jobs{without(factors)};
    return {drift(runs_.make(jobs, explanation.stretch.last)[0], explanation)};
  }

  void try_pairs(StretchExplanation& explanation) {
    std::vector<Effect> singles;
    for (const FactorEffect& single : explanation.singles) singles.push_back(single.effect);
    if (!do_not_add_up(explanation.normal.chance, singles, explanation.all->effect)) return;
    std::vector<std::size_t> order(singles.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) {
      return std::abs(singles[i].metres) + 0.01 * std::abs(singles[i].lost);
    });
    order.resize(std::min(order.size(), kFactorsInPairs));
    std::vector<Job> jobs;
    for (std::size_t b = 1; b < order.size(); ++b) {
      for (std::size_t a = 0; a < b; ++a) {
        if (jobs.size() >= static_cast<std::size_t>(request_.pairs)) continue;
        jobs.push_back(without({order[a], order[b]}));
      }
    }
    explanation.pairs = effects(jobs, explanation, explanation.normal, 1);
    judge(explanation.normal, explanation.singles);
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

std::vector<std::size_t> causes_of(const StretchExplanation& stretch) {
  const AsItWas& was = stretch.normal.chance;
  Shares shares = shares_of(stretch.normal, stretch.singles);
  const FactorEffect* joint = nullptr;
  for (const FactorEffect& pair : stretch.pairs) {
    const Effect& one = stretch.singles[pair.factors[0]].effect;
    const Effect& other = stretch.singles[pair.factors[1]].effect;
    if (!is_joint_cause(was, one, other, pair.effect)) continue;
    if (joint == nullptr || caused_share(was, pair.effect) > caused_share(was, joint->effect)) {
      joint = &pair;
    }
  }
  if (joint != nullptr) {
    for (const std::size_t i : joint->factors) {
      shares[i] = {caused_share(was, joint->effect), joint->effect.metres};
    }
  }
  return by_share(shares);
}

}  // namespace vinebench::harness
