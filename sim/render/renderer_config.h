// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/config/config_field.h"
#include "sim/render/gl/platform/gl_backend.h"

namespace vinebench::sim {

/// What draws the scene.
enum class RenderEngineKind { kGl, kMujoco, kFake };

inline std::vector<std::string> yaml_names(RenderEngineKind) {
  return {"gl", "mujoco", "fake"};
}

inline constexpr int kMostSupersampling = 4;

struct RendererConfig {
  RenderEngineKind engine = RenderEngineKind::kGl;  ///< what draws the images
  GlBackend backend = GlBackend::kAuto;             ///< of `gl`
  double lod_scale = 1.0;  ///< of `gl`: distances of the levels of detail are multiplied by this
  int shadow_map_size = 2048;  ///< of `gl`: pixels a side; 0 draws no shadows
  int supersampling = 1;       ///< samples a pixel's side that colours are the mean of
  template <class Archive>
  void serialize(Archive& archive) {
    archive("engine", engine);
    archive("backend", backend);
    archive("lod_scale", lod_scale, Range::between(0.05, 20));
    archive("shadow_map_size", shadow_map_size, Range::between(0, 8192));
    archive("supersampling", supersampling, Range::between(1, kMostSupersampling));
  }
};

/// How much a picture may cost: `fine` draws plants in full detail three times as far and colours
/// as the mean of four samples a pixel.
enum class RenderQuality { kFast, kFine };

inline std::vector<std::string> yaml_names(RenderQuality) {
  return {"fast", "fine"};
}

/// Level of detail and supersampling of that quality; `fast` changes nothing.
void choose_quality(RendererConfig& config, RenderQuality quality);

/// The platform of that name where the configuration leaves it open; an empty name changes nothing.
/// Throws Error for a name that is not in yaml_names(GlBackend).
void choose_backend(RendererConfig& config, const std::string& name);

}  // namespace vinebench::sim
