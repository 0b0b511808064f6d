// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "slam/optimisation/problem_builder.h"

namespace vinebench::test {

/// Moves the map's keyframes to where the problem has them.
inline void write_poses(const slam::ProblemBuilder& problem, slam::Map& map) {
  const std::vector<Pose> poses = problem.poses(map);
  for (slam::Keyframe& keyframe : map.keyframes()) {
    keyframe.T_map_body = poses[static_cast<std::size_t>(keyframe.id)];
  }
}

}  // namespace vinebench::test
