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

/// What the judge found. A function of the record alone: no wall-clock figure.
struct RunResults {
  double coverage = 0;                  ///< share of frames with a pose at their own time, 0 to 1
  int lost_frames = 0;                  ///< without a pose after the first that had one
  int losses = 0;                       ///< how often tracking went from a pose to none
  std::optional<Evaluation> corrected;  ///< of every frame's pose after all corrections
  std::optional<Evaluation> live;       ///< of the poses as they were known at their own frame
  std::optional<Consistency> consistency;
  std::optional<double> end_error;  ///< m, from the route's end to where the body truly ended
  LoopVerdict loops;
  std::optional<OcclusionSegment> blind;  ///< where the scenario asks for one
};

/// Throws Error when an expectation names a camera that the rig has not.
RunResults measure(const RunRecord& record, const Trial& trial);

}  // namespace vinebench::harness
