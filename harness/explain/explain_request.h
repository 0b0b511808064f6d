// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "harness/experiment/scenario.h"
#include "harness/explain/effects.h"
#include "harness/machine.h"

namespace vinebench::harness {

/// A run to explain, which is repeated for it.
struct ExplainRequest {
  ScenarioConfig scenario;
  std::string live_poses;  ///< of the run, as a TUM file: what its repetition must give
  /// Why a repetition may differ, for the message; empty: unknown.
  std::string differences{};
  std::vector<Stretch> stretches;  ///< in order of their first frames
  Machine machine;
  double lead = 2;   ///< s before a stretch at which factors are taken away
  int placebos = 4;  ///< reruns with another noise, at least 2
  int repeats = 2;   ///< further reruns, with other noise, where chance could explain an effect,
                     ///< up to four times; before the first and the third, more placebos
  int pairs = 10;    ///< pairs to try at most; 0: none
  int at_once = 1;   ///< reruns side by side
  std::ostream* progress = nullptr;
};

}  // namespace vinebench::harness
