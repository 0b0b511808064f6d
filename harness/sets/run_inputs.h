// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "harness/experiment/scenario.h"

namespace vinebench::harness {

/// Hash of this program's executable.
const std::string& program_digits();

/// Fingerprint of the inputs of a run: this program's executable, the resolved scenario with its
/// seed, and the files that the scenario names. Files that those name in turn (a rover's meshes)
/// are not included.
std::string fingerprint_of_inputs(const ScenarioConfig& scenario);

}  // namespace vinebench::harness
