// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "harness/judge/findings/discrepancy.h"
#include "sim/simulation.h"

namespace vinebench::harness {

/// What a SLAM system that is told this rig and these tags is told wrong about the simulated world
/// and sensors: calibration, survey, and the instants of images. `nominal` is the simulation's rig
/// before its calibration errors. The one that moves the images most comes first. For the judge
/// alone.
std::vector<Discrepancy> known_discrepancies(const sim::SimulationConfig& simulation,
                                             std::uint64_t seed, const Rig& nominal,
                                             const Rig& told,
                                             const std::vector<RegisteredTag>& tags);

}  // namespace vinebench::harness
