// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "slam/map/map.h"

namespace vinebench::slam {

/// The landmarks that at least `min_observations` keyframes saw, as a PLY file (binary, little
/// endian): x y z in the map frame (m), the normal towards the cameras that saw it, and red green
/// blue, which are the grey level in its oldest patch, 128 where there is none.
std::string format_ply(const Map& map, int min_observations);

/// Writes a PLY file, whole or not at all. Throws Error with the system's reason.
void save_point_cloud(const Map& map, int min_observations, const std::filesystem::path& file);

}  // namespace vinebench::slam
