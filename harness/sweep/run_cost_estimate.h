// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "harness/experiment/scenario.h"

namespace vinebench::harness {

/// How long a scenario's rover drives, s.
double drive_duration(const ScenarioConfig& scenario);

/// What a run takes, s of one core, by the frames of its route and the pixels of its rig: for
/// dividing work, and within a factor of five (leaves near the cameras, global adjustments).
/// Throws Error if the rig cannot be read.
double estimate_cost(const ScenarioConfig& scenario);

/// Median of what the runs of each scenario in the folder took, s, by the scenario's name. Throws
/// Error as find_runs().
std::map<std::string, double> measured_costs(const std::filesystem::path& folder);

}  // namespace vinebench::harness
