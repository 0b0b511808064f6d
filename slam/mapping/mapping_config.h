// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/config/config_field.h"

namespace vinebench::slam {

/// When what local mapping found out reaches tracking.
enum class MappingSchedule {
  kLockstep,  ///< after a fixed number of frames: the same result on every machine
  kLive,      ///< as soon as it is there; tracking never waits for it
};
inline std::vector<std::string> yaml_names(MappingSchedule) {
  return {"lockstep", "live"};
}

struct MappingConfig {
  MappingSchedule schedule = MappingSchedule::kLockstep;  ///< when results of mapping join
  int delay = 4;       ///< frames after which a local adjustment joins in lockstep; 0 is at once
  int window = 10;     ///< keyframes that a local adjustment moves
  int iterations = 6;  ///< of a local adjustment
  int global_iterations = 25;  ///< of a global adjustment
  int min_observations = 3;    ///< keyframes that must see a landmark (paper, Sect. III-A)
  int trial_keyframes = 3;     ///< keyframes after which a landmark with fewer is dropped
  int neighbours = 6;          ///< covisible keyframes searched for new landmarks

  template <class Archive>
  void serialize(Archive& archive) {
    archive("schedule", schedule);
    archive("delay", delay, Range::between(0, 100));
    archive("window", window, Range::between(2, 100));
    archive("iterations", iterations, Range::between(1, 100));
    archive("global_iterations", global_iterations, Range::between(1, 500));
    archive("min_observations", min_observations, Range::between(2, 10));
    archive("trial_keyframes", trial_keyframes, Range::between(1, 100));
    archive("neighbours", neighbours, Range::between(0, 100));
  }
};

}  // namespace vinebench::slam
