// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "harness/judge/consistency.h"
#include "harness/judge/evaluation.h"
#include "harness/judge/loop_judge.h"
#include "harness/judge/occlusion.h"
#include "harness/judge/trial.h"
#include "harness/run/run_record.h"

namespace vinebench::harness {

/// The result of the evaluation. A function of the record only: no wall-clock times.
struct RunResults {
  double coverage = 0;                    ///< share of frames with a live pose, 0 to 1
  int lost_frames = 0;                    ///< without a pose after the first frame with one
  int losses = 0;                         ///< how often tracking went from a pose to none
  std::optional<Evaluation> corrected;    ///< of every frame's pose after all corrections
  std::optional<Evaluation> live;         ///< of the live poses
  std::optional<WorldErrors> live_world;  ///< of those that were told in the world
  std::optional<Drift> drift;             ///< of the live poses before the first loop closure
  std::optional<Consistency> consistency;
  std::optional<double> end_error;  ///< m, from the route's end to the true final position
  LoopVerdict loops;
  std::optional<OcclusionSegment> blind;  ///< if the scenario expects one
};

/// Throws Error if an expectation names a camera that the rig does not have.
RunResults measure(const RunRecord& record, const Trial& trial);

}  // namespace vinebench::harness
