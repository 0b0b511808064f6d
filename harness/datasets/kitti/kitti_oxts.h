// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "core/frame.h"
#include "core/trajectory.h"

namespace vinebench::harness {

/// What the inertial and satellite unit of KITTI's raw data tells, in the unit's own axes (x ahead,
/// y left, z up).
struct KittiOxts {
  Trajectory poses;  ///< T_world_unit: x east, y north, z up; 0 is the first position
  std::vector<ImuSample> inertial;
};

/// Reads the folder `oxts`: data/<number>.txt, a line each, and timestamps.txt. Positions are
/// projected as by the data's own tools (Mercator, true to scale at the first latitude). Throws
/// Error with file and line.
KittiOxts read_kitti_oxts(const std::filesystem::path& folder);

}  // namespace vinebench::harness
