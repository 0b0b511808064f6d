// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sim/world.h"
#include "slam/base/rig.h"

namespace vinebench {

/// What `vinebench bench render` measures.
struct RenderBenchmark {
  std::string name;
  WorldConfig world;
  Rig rig;
  std::vector<Pose> route;  ///< T_world_body of each frame
  std::uint64_t seed = 1;
};

/// Poses of a rover that drives up the aisle between the first two rows and back along it, `count`
/// in all.
std::vector<Pose> aisle_route(const WorldConfig& world, int count);

/// Renders every frame of the route with `threads` threads. Returns medians over the frames, ms:
/// for each camera alone, `cpu_ms` of the whole process and `wall_ms`; for whole frames
/// `frame_wall_ms`; and `memory_mib` of the process, and a hash of all pictures.
nlohmann::ordered_json measure_rendering(const RenderBenchmark& benchmark, int threads);

}  // namespace vinebench
