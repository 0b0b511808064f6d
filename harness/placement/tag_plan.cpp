// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/placement/tag_plan.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>

namespace vinebench::harness {
namespace {

/// An exchange that gains less is none.
constexpr double kLeastGain = 1e-6;  // m

constexpr int kMostRounds = 5;

using Measured = std::vector<Matrix6d>;

void add(const TagCandidate& tag, Measured& measured) {
  for (const auto& [pose, information] : tag.information) measured[pose] += information;
}

class Planner {
 public:
  Planner(const PoseChain& chain, const std::vector<TagCandidate>& candidates)
      : chain_(chain),
        candidates_(candidates),
        measured_(chain.size(), Matrix6d::Zero()),
        is_chosen_(candidates.size(), false) {}

  /// Adds those that tell most, until there are so many.
  void choose(int budget) {
    // What a tag adds never grows, so that gains of before are bounds (Minoux 1978).
    std::priority_queue<std::pair<double, std::size_t>> bounds;
    for (std::size_t c = 0; c < candidates_.size(); ++c) {
      if (!is_chosen_[c] && !candidates_[c].information.empty()) {
        bounds.emplace(std::numeric_limits<double>::infinity(), c);
      }
    }
    while (static_cast<int>(chosen_.size()) < budget && !bounds.empty()) {
      const std::size_t best = bounds.top().second;
      bounds.pop();
      const double gain = gain_of(best);
      if (bounds.empty() || gain >= bounds.top().first) {
        take(best);
      } else {
        bounds.emplace(gain, best);
      }
    }
  }

  /// Exchanges single tags for others as long as the error falls.
  void exchange() {
    bool changed = true;
    for (int round = 0; changed && round < kMostRounds; ++round) {
      changed = false;
      for (std::size_t i = 0; i < chosen_.size(); ++i) changed |= exchange_one(i);
    }
  }

  TagPlan plan() const {
    TagPlan plan;
    plan.chosen = chosen_;
    plan.information = information_;
    plan.most_information = plan.information + most_to_add();
    plan.errors = chain_.position_errors(measured_);
    plan.error = share_of(plan.errors, kPlannedShare);
    return plan;
  }

  int size() const { return static_cast<int>(chosen_.size()); }

  double error() const { return share_of(chain_.position_errors(measured_), kPlannedShare); }

  void take(std::size_t candidate) {
    add(candidates_[candidate], measured_);
    information_ = chain_.information(measured_);
    is_chosen_[candidate] = true;
    chosen_.push_back(candidate);
  }

 private:
  double gain_of(std::size_t candidate) const {
    Measured with = measured_;
    add(candidates_[candidate], with);
    return chain_.information(with) - information_;
  }

  /// The sum of the greatest gains of as many others: no set of that size has more beside these.
  double most_to_add() const {
    std::vector<double> gains;
    for (std::size_t c = 0; c < candidates_.size(); ++c) {
      if (!is_chosen_[c] && !candidates_[c].information.empty()) gains.push_back(gain_of(c));
    }
    std::ranges::sort(gains, std::greater<>());
    gains.resize(std::min(gains.size(), chosen_.size()));
    return std::accumulate(gains.begin(), gains.end(), 0.0);
  }

  bool exchange_one(std::size_t i) {
    const std::size_t old = chosen_[i];
    double least = error() - kLeastGain;
    std::size_t best = old;
    Measured without(chain_.size(), Matrix6d::Zero());
    for (const std::size_t c : chosen_) {
      if (c != old) add(candidates_[c], without);
    }
    for (std::size_t c = 0; c < candidates_.size(); ++c) {
      if (is_chosen_[c] || candidates_[c].information.empty()) continue;
      Measured with = without;
      add(candidates_[c], with);
      const double error = share_of(chain_.position_errors(with), kPlannedShare);
      if (error >= least) continue;
      least = error;
      best = c;
    }
    if (best == old) return false;
    is_chosen_[old] = false;
    is_chosen_[best] = true;
    chosen_[i] = best;
    sum_up();
    return true;
  }

  void sum_up() {
    measured_.assign(chain_.size(), Matrix6d::Zero());
    for (const std::size_t c : chosen_) add(candidates_[c], measured_);
    information_ = chain_.information(measured_);
  }

  const PoseChain& chain_;
  const std::vector<TagCandidate>& candidates_;
  Measured measured_;
  double information_ = 0;  ///< of these, nats
  std::vector<std::size_t> chosen_;
  std::vector<bool> is_chosen_;
};

}  // namespace

TagPlan plan_tags(const PoseChain& chain, const std::vector<TagCandidate>& candidates,
                  const TagDemand& demand) {
  // Before it is tried tag by tag.
  const bool hopeless = demand.error && predict_tags(chain, candidates).error > *demand.error;
  for (int tags = demand.error && !hopeless ? 0 : demand.budget;; ++tags) {
    Planner planner(chain, candidates);
    planner.choose(tags);
    if (!hopeless) planner.exchange();
    const bool last = tags >= demand.budget || planner.size() < tags;
    if (last || planner.error() <= *demand.error) return planner.plan();
  }
}

TagPlan predict_tags(const PoseChain& chain, const std::vector<TagCandidate>& tags) {
  Planner planner(chain, tags);
  for (std::size_t t = 0; t < tags.size(); ++t) planner.take(t);
  return planner.plan();
}

}  // namespace vinebench::harness
