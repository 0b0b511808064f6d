// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/files/cache_folder.h"
#include "core/truth/scene_index.h"
#include "sim/render/engine_pool.h"
#include "sim/simulation_config.h"

namespace vinebench::sim {

/// The scene of a simulation and the engines that draw it. Several simulations, one after another
/// or in forked processes, may share one.
class DrawnScene {
 public:
  /// With engines for that many threads. Throws Error as build_scene() and make_render_engine() do.
  DrawnScene(const SimulationConfig& config, std::uint64_t seed, const CacheFolder& cache,
             std::size_t users);

  /// Whether a simulation's scene, drawn with its renderer, is the same: its world, rover, renderer
  /// and seed.
  bool serves(const SimulationConfig& config, std::uint64_t seed) const;

  EnginePool& engines() { return *engines_; }
  const SceneIndex& index() const { return index_; }
  const Light& light() const { return light_; }
  /// Beside the rover and what the wind moves.
  bool something_moves() const { return something_moves_; }

 private:
  std::string identity_;
  SceneIndex index_;
  Light light_;
  bool something_moves_ = false;
  std::optional<EnginePool> engines_;
};

/// Whether a process that draws with this renderer, in the calling thread alone, may be forked, and
/// both may draw on: with OSMesa's software renderer, and without OpenGL. Call it before the first
/// use of OpenGL in this process: it makes OSMesa draw without threads from then on.
bool draws_in_calling_thread(const RendererConfig& config);

}  // namespace vinebench::sim
