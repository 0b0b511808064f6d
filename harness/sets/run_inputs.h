// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "harness/experiment/scenario.h"

namespace vinebench::harness {

/// Fingerprint of what a run is a function of: this program's own file, the resolved scenario with
/// its seed, and the files that the scenario names. What those name in turn (a rover's meshes) is
/// not looked at.
std::string fingerprint_of_inputs(const ScenarioConfig& scenario);

}  // namespace vinebench::harness
