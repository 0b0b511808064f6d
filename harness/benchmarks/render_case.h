// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/geometry/rig.h"
#include "harness/machine.h"
#include "sim/render/renderer_config.h"
#include "sim/world/world.h"

namespace vinebench::harness {

/// Settings of `vinebench bench render` for one world.
struct RenderBenchmark {
  std::string name;
  sim::WorldConfig world;
  Rig rig;
  std::vector<Pose> route;  ///< T_world_body of each frame
  std::uint64_t seed = 1;
  int threads = 2;
  sim::RendererConfig renderer;
  bool mujoco = false;  ///< also measure MuJoCo's own renderer on the same scene
  CacheFolder plant_cache;
  std::filesystem::path images;  ///< folder for both renderers' images of one pose, if any
};

/// Poses of a rover in the middle aisle (in the order of `rows`), which sees most of a world:
/// `count` poses from one end to the other, alternately looking ahead and back.
std::vector<Pose> aisle_route(const sim::WorldConfig& world, int count);

/// What `vinebench bench render` measures.
struct RenderSuite {
  /// World files; the small one, the large one and the latter with many more rows where empty.
  std::vector<std::string> worlds;
  std::string small_world;
  std::string large_world;
  std::string rig;
  std::string images;  ///< folder, as RenderBenchmark::images
  int threads = 2;
  int frames = 24;
  bool mujoco = true;  ///< also MuJoCo's own renderer, on csl-vineyard
  Machine machine;
};

/// The worlds of a suite, in order. Throws Error for a file that is not there.
std::vector<RenderBenchmark> render_cases(const RenderSuite& suite);

}  // namespace vinebench::harness
