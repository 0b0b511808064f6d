// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/odometry_factors.h"

namespace vinebench::slam {

void OdometryFactors::add_to(ProblemBuilder& problem, const Map& map) {
  for (const int id : problem.window().moved) {
    const std::optional<OdometryLink>& link = map.keyframe(id).link;
    if (!link || !problem.takes_part(link->from)) continue;
    factors_.emplace_back(link->T_from_to, link->covariance);
    problem.add_factor(factors_.back(), nullptr,
                       {problem.pose_of(link->from), problem.pose_of(id)});
  }
}

}  // namespace vinebench::slam
