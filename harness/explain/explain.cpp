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
#include "harness/explain/child_drive.h"
#include "harness/explain/repeated_run.h"
#include "harness/sets/child_process.h"
#include "sim/world/world_layout.h"

namespace vinebench::harness {
namespace {

constexpr std::size_t kFactorsInPairs = 5;

/// A rerun to make: without some factors, or with a placebo.
struct Job {
  std::string name;
  Variant variant;
  std::vector<std::size_t> factors{};
  bool from_start = false;
};

void check_can_be_repeated(const ExplainRequest& request) {
  const ScenarioConfig& scenario = request.scenario;
  if (scenario.slam.external || scenario.slam.plugin) {
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

/// Repeats a run and parts of it.
class Explainer {
 public:
  explicit Explainer(const ExplainRequest& request)
      : request_(request),
        known_(request.live_poses, request.differences),
        original_{request.scenario},
        rate_hz_(load_rig(request.scenario.simulation.rover.rig).rate_hz) {
    result_.factors = factors_of(request.scenario);
  }

  Explanation run() {
    const std::int64_t last = last_start();
    std::optional<ChildDrive> drive;
    if (last > 0)
      drive.emplace([&, last] { return original_drive(last - 1); }, told_rig(original_));
    const auto slam =
        slam::make_slam(request_.scenario.slam, told_rig(original_),
                        sim::registered_tags(request_.scenario.simulation.world), pool_);
    slam_ = slam.get();
    for (const Stretch& stretch : request_.stretches) {
      while (next_ < start_of(stretch)) advance(*drive);
      result_.stretches.push_back(explain_stretch(stretch));
    }
    return result_;
  }

 private:
  std::unique_ptr<FrameSource> original_drive(std::int64_t last) {
    drawing_ = std::make_unique<WorkerPool>(1);
    return std::make_unique<VariantDrive>(original_, Splice{}, last, request_.machine, *drawing_);
  }

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

  /// The next frame as it was.
  void advance(ChildDrive& drive) {
    const std::optional<Sample> sample = drive.next();
    if (!sample) fail("the drive ends before frame {}", next_);
    if (!sample->truth.path.empty()) splice_.path_end = sample->truth.path.back();
    splice_.before = sample->frame.stamp;
    splice_.first = ++next_;
    past_.push_back(step_of(*sample, slam_->process(sample->frame)));
    known_.check(past_.back());
  }

  Job without(const std::vector<std::size_t>& factors) const {
    Job job{.name = "without", .variant = original_, .factors = factors};
    for (const std::size_t i : factors) {
      const Factor& factor = result_.factors[i];
      factor.remove(job.variant);
      job.from_start = job.from_start || factor.from_start;
      job.name += " " + factor.name;
    }
    return job;
  }

  /// From the start on, up to the last stretch's end, for all of them.
  Rerun rerun(const Job& job, const Stretch& stretch) const {
    if (job.from_start) {
      return run_variant(job.variant, {}, last_frame(), request_.machine, nullptr);
    }
    return run_variant(job.variant, splice_, stretch.last, request_.machine, slam_);
  }

  /// Makes the reruns. Those whose drive turns out to be another one are made again from the start.
  std::vector<Rerun> make(std::vector<Job>& jobs, const Stretch& stretch) {
    std::vector<Rerun> reruns(jobs.size());
    std::vector<std::size_t> open(jobs.size());
    std::iota(open.begin(), open.end(), 0);
    while (!open.empty()) {
      std::erase_if(open, [&](std::size_t i) {
        const auto known = from_start_.find(jobs[i].name);
        if (known == from_start_.end()) return false;
        jobs[i].from_start = true;
        reruns[i] = known->second;
        return true;
      });
      make_once(jobs, open, stretch, reruns);
      std::erase_if(open, [&](std::size_t i) {
        if (jobs[i].from_start) from_start_[jobs[i].name] = reruns[i];
        return reruns[i].same_drive;
      });
      for (const std::size_t i : open) jobs[i].from_start = true;
    }
    return reruns;
  }

  void make_once(const std::vector<Job>& jobs, const std::vector<std::size_t>& open,
                 const Stretch& stretch, std::vector<Rerun>& reruns) {
    std::string failure;
    run_in_children(
        {.count = open.size(),
         .at_once = request_.at_once,
         .name = [&](std::size_t i) { return "rerun " + jobs[open[i]].name; },
         .job = [&](std::size_t i) { return pack_rerun(rerun(jobs[open[i]], stretch)); },
         .done =
             [&](std::size_t i, const ChildOutcome& outcome) {
               if (!outcome.ok) {
                 failure = fmt::format("{}: {}", jobs[open[i]].name, outcome.text);
                 return;
               }
               reruns[open[i]] = unpack_rerun(outcome.text);
               note(jobs[open[i]], reruns[open[i]]);
             },
         .stopped = [&] { return !failure.empty(); }});
    if (!failure.empty()) fail("{}", failure);
  }

  void note(const Job& job, const Rerun& rerun) {
    ++result_.reruns;
    result_.rerun_seconds += rerun.seconds;
    if (request_.progress == nullptr) return;
    *request_.progress << fmt::format("{}: {:.1f} s of processor time\n", job.name, rerun.seconds)
                       << std::flush;
  }

  /// With the frame that it is aligned at, which is of the past unless the rerun has one of its
  /// own.
  StretchDrift drift(const Rerun& rerun, const StretchExplanation& explanation) const {
    std::vector<Step> steps = rerun.steps;
    if (!steps.empty() && steps.front().index == next_ && !past_.empty()) {
      steps.insert(steps.begin(), past_.back());
    }
    return drift_of(steps, explanation.stretch, explanation.aligned);
  }

  StretchExplanation explain_stretch(const Stretch& stretch) {
    StretchExplanation explanation{.stretch = stretch};
    explanation.aligned = std::max<std::int64_t>(0, next_ - 1);
    measure_chance(explanation);
    std::vector<Job> jobs;
    const std::size_t count = result_.factors.size();
    for (std::size_t i = 0; i < count; ++i) jobs.push_back(without({i}));
    explanation.singles = effects(jobs, explanation);
    if (count > 1) {
      std::vector<std::size_t> all(count);
      std::iota(all.begin(), all.end(), 0);
      std::vector<Job> together{without(all)};
      explanation.all = effects(together, explanation)[0];
      try_pairs(explanation);
    }
    explanation.causes = causes_of(explanation);
    return explanation;
  }

  /// The run itself, which must be the same, and placebos.
  void measure_chance(StretchExplanation& explanation) {
    std::vector<Job> jobs{{.name = "as it was", .variant = original_}};
    for (int i = 1; i <= request_.placebos; ++i) {
      jobs.push_back(
          {.name = fmt::format("placebo {}", i), .variant = with_other_noise(original_, i)});
    }
    const std::vector<Rerun> reruns = make(jobs, explanation.stretch);
    std::ranges::for_each(reruns[0].steps, [&](const Step& step) { known_.check(step); });
    if (reruns[0].steps.empty()) fail("the drive ends before frame {}", next_);
    std::vector<StretchDrift> drifts;
    for (const Rerun& one : reruns) drifts.push_back(drift(one, explanation));
    explanation.was = drifts[0];
    explanation.chance = as_it_was(drifts);
    result_.null_seconds += reruns[0].seconds / static_cast<double>(request_.stretches.size());
  }

  std::vector<FactorEffect> effects(std::vector<Job>& jobs, const StretchExplanation& explanation) {
    std::vector<FactorEffect> list(jobs.size());
    add_reruns(jobs, explanation, list);
    std::vector<Job> again;
    std::vector<std::size_t> of;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      for (int k = 1; list[i].effect.is_open && k <= request_.repeats; ++k) {
        again.push_back(jobs[i]);
        again.back().name += fmt::format(", again {}", k);
        again.back().variant = with_other_noise(jobs[i].variant, k);
        of.push_back(i);
      }
    }
    const std::vector<Rerun> reruns = make(again, explanation.stretch);
    for (std::size_t i = 0; i < again.size(); ++i) {
      list[of[i]].without.push_back(drift(reruns[i], explanation));
    }
    for (FactorEffect& one : list) one.effect = effect_of(explanation.chance, one.without);
    return list;
  }

  void add_reruns(std::vector<Job>& jobs, const StretchExplanation& explanation,
                  std::vector<FactorEffect>& list) {
    const std::vector<Rerun> reruns = make(jobs, explanation.stretch);
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      list[i].factors = jobs[i].factors;
      list[i].from_start = jobs[i].from_start;
      list[i].without.push_back(drift(reruns[i], explanation));
      list[i].effect = effect_of(explanation.chance, list[i].without);
    }
  }

  void try_pairs(StretchExplanation& explanation) {
    std::vector<Effect> singles;
    for (const FactorEffect& single : explanation.singles) singles.push_back(single.effect);
    if (!do_not_add_up(explanation.chance, singles, explanation.all->effect)) return;
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
    explanation.pairs = effects(jobs, explanation);
    for (FactorEffect& pair : explanation.pairs) {
      pair.interaction =
          interaction_of(singles[pair.factors[0]], singles[pair.factors[1]], pair.effect);
    }
  }

  const ExplainRequest& request_;
  KnownPoses known_;
  Variant original_;
  double rate_hz_;
  WorkerPool pool_{1};
  std::unique_ptr<WorkerPool> drawing_;  ///< in the drive's process
  slam::MappingSystem* slam_ = nullptr;
  std::int64_t next_ = 0;  ///< index of the next frame
  Splice splice_;
  std::vector<Step> past_;
  std::map<std::string, Rerun> from_start_;  ///< by the jobs' names
  Explanation result_;
};

}  // namespace

Explanation explain(const ExplainRequest& request) {
  check_can_be_repeated(request);
  cv::setNumThreads(1);  // threads would be missing in a forked process
  return Explainer(request).run();
}

std::vector<std::size_t> causes_of(const StretchExplanation& stretch) {
  const AsItWas& was = stretch.chance;
  const auto share = [&](const Effect& effect) {
    double most = 0;
    if (effect.drift_is_caused) most = effect.metres / was.metres.typical();
    if (effect.losses_are_caused) most = std::max(most, effect.lost / was.lost.typical());
    return most;
  };
  std::map<std::size_t, double> shares;
  for (const FactorEffect& single : stretch.singles) {
    if (single.effect.is_cause()) shares[single.factors[0]] = share(single.effect);
  }
  const FactorEffect* joint = nullptr;
  for (const FactorEffect& pair : stretch.pairs) {
    const Effect& one = stretch.singles[pair.factors[0]].effect;
    const Effect& other = stretch.singles[pair.factors[1]].effect;
    if (!is_joint_cause(was, one, other, pair.effect)) continue;
    if (joint == nullptr || share(pair.effect) > share(joint->effect)) joint = &pair;
  }
  if (joint != nullptr) {
    for (const std::size_t i : joint->factors) shares[i] = share(joint->effect);
  }
  std::vector<std::size_t> causes;
  for (const auto& [factor, ignored] : shares) causes.push_back(factor);
  std::ranges::stable_sort(causes, std::greater(), [&](std::size_t i) { return shares[i]; });
  return causes;
}

}  // namespace vinebench::harness
