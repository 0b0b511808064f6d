// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "core/geometry/rig.h"
#include "sim/config_files.h"
#include "sim/rover/rover.h"

namespace vinebench::test {

inline constexpr double kRoverFrameRate = 15;

inline const std::filesystem::path& rover_folder() {
  static const auto folder = std::filesystem::path(VINEBENCH_SOURCE_DIR) / "models/csl-rover";
  return folder;
}

inline sim::RoverConfig csl_rover() {
  return sim::load_rover(rover_folder() / "rover.yaml");
}

/// One row far from the test drives.
inline sim::WorldConfig field() {
  sim::WorldConfig world;
  world.rows = {{{0, 10}, {4, 10}}};
  return world;
}

inline Eigen::Vector2d position_of(const sim::Rover& rover) {
  return rover.T_world_body().translation.head<2>();
}

}  // namespace vinebench::test
