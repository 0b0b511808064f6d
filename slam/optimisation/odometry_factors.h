// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>

#include "slam/factors/relative_pose_factor.h"
#include "slam/optimisation/problem_builder.h"

namespace vinebench::slam {

/// Ties each moved keyframe after an odometry gap to the one before it, where both take part.
class OdometryFactors : public FactorSource {
 public:
  void add_to(ProblemBuilder& problem, const Map& map) override;

 private:
  std::deque<RelativePoseFactor> factors_;
};

}  // namespace vinebench::slam
