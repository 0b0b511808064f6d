// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sim/rover/rover.h"
#include "sim/world/world.h"

namespace vinebench::sim {

/// Reads a vineyard's YAML file and sets dotted keys ("sun.elevation_deg") to the YAML values
/// given. Throws Error that lists every violation with its line.
WorldConfig load_world(const std::filesystem::path& file,
                       const std::vector<std::pair<std::string, std::string>>& overrides = {});

/// Reads a rover's YAML file. Throws Error that lists every violation with its line.
RoverConfig load_rover(const std::filesystem::path& file);

}  // namespace vinebench::sim
