// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/drawn_scene.h"

#include <thread>

#include "core/config/yaml_writer.h"
#include "sim/render/factory/make_render_engine.h"
#include "sim/render/gl/platform/gl_context.h"
#include "sim/rover/rover_asset.h"
#include "sim/scene/scene_naming.h"

namespace vinebench::sim {
namespace {

/// All that the scene and its engines are made of, as text.
std::string identity_of(const SimulationConfig& config, std::uint64_t seed) {
  return fmt::format("{}\n{}\n{}\n{}", seed, config.rover.model.string(), format_yaml(config.world),
                     format_yaml(config.renderer));
}

}  // namespace

DrawnScene::DrawnScene(const SimulationConfig& config, std::uint64_t seed, const CacheFolder& cache,
                       std::size_t users)
    : identity_(identity_of(config, seed)) {
  Scene scene =
      build_scene(config.world, seed, cache, config.renderer.engine != RenderEngineKind::kFake);
  light_ = scene.light;
  something_moves_ = !scene.motions.empty();
  add_rover(scene, config.rover.model);
  index_ = index_of(scene);
  engines_.emplace(static_cast<int>(users), static_cast<int>(std::thread::hardware_concurrency()),
                   [&] { return make_render_engine(scene, config.renderer); });
}

bool DrawnScene::serves(const SimulationConfig& config, std::uint64_t seed) const {
  return identity_ == identity_of(config, seed);
}

bool draws_in_calling_thread(const RendererConfig& config) {
  if (config.engine == RenderEngineKind::kFake) return true;
  const bool osmesa =
      config.backend == GlBackend::kOsmesa || (config.backend == GlBackend::kAuto && has_osmesa());
  if (config.engine != RenderEngineKind::kGl || !osmesa) return false;
  draw_without_threads();
  return true;
}

}  // namespace vinebench::sim
