// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "harness/placement/pose_chain.h"
#include "harness/placement/tag_candidates.h"

namespace vinebench::harness {

/// So many of the poses have at most the error that plans are made for.
inline constexpr double kPlannedShare = 0.95;

/// What is asked of a plan: so many tags, or as few as keep the error.
struct TagDemand {
  int budget = 10;                ///< tags at most
  std::optional<double> error{};  ///< m, that kPlannedShare of the poses are to have at most
};

/// Which candidates are to be hung.
struct TagPlan {
  std::vector<std::size_t> chosen;  ///< indices of candidates, the one that tells most first
  double information = 0;           ///< nats (PoseChain::information)
  double most_information = 0;      ///< that no set of as many can exceed
  double error = 0;                 ///< m, predicted, of kPlannedShare of the poses
  std::vector<double> errors;       ///< m, of each pose
};

/// Chooses tags. First greedily by what each tells beside those before, by which the set has at
/// least 1 - 1/e of the information of the best one (Nemhauser, Wolsey and Fisher 1978); how near
/// it is to the best is bounded besides by what every other tag would still add. Then single tags
/// are exchanged as long as that lowers the error. Where an error is demanded, this is done for one
/// more tag each time, until it is kept; where all together do not keep it, the plan has all that
/// the budget allows.
TagPlan plan_tags(const PoseChain& chain, const std::vector<TagCandidate>& candidates,
                  const TagDemand& demand);

/// What tags that hang already are predicted to give.
TagPlan predict_tags(const PoseChain& chain, const std::vector<TagCandidate>& tags);

}  // namespace vinebench::harness
