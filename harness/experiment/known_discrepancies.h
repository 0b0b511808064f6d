// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "harness/judge/findings/discrepancy.h"
#include "sim/simulation.h"
#include "slam/odometry/wheel_odometry.h"

namespace vinebench::harness {

/// What a SLAM system that is told this rig, these tags and wheels is told wrong about the
/// simulated world and sensors: calibration, survey, the instants of images, and sizes of the
/// wheels' drive. The one that moves the images most comes first. For the judge alone.
std::vector<Discrepancy> known_discrepancies(const sim::SimulationConfig& simulation,
                                             std::uint64_t seed, const Rig& told,
                                             const std::vector<RegisteredTag>& tags,
                                             const std::optional<slam::MecanumWheels>& wheels);

}  // namespace vinebench::harness
