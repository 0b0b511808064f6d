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

/// What a SLAM system is told of the robot and of its world.
struct ToldRobot {
  Rig rig;
  std::vector<RegisteredTag> tags;
  std::optional<slam::MecanumWheels> wheels;
};

/// What of that is not so in the simulated world and sensors: calibration, survey, the instants of
/// images, and sizes of the wheels' drive. `nominal` is the simulation's rig before its calibration
/// errors. The one that moves the images most comes first. For the judge alone.
std::vector<Discrepancy> known_discrepancies(const sim::SimulationConfig& simulation,
                                             std::uint64_t seed, const Rig& nominal,
                                             const ToldRobot& told);

}  // namespace vinebench::harness
