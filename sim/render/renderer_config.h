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

struct RendererConfig {
  RenderEngineKind engine = RenderEngineKind::kGl;
  GlBackend backend = GlBackend::kAuto;  ///< of `gl`
  double lod_scale = 1.0;  ///< of `gl`: distances of the levels of detail are multiplied by this
  int shadow_map_size = 2048;  ///< of `gl`: pixels a side; 0 draws no shadows
  template <class Archive>
  void serialize(Archive& archive) {
    archive("engine", engine);
    archive("backend", backend);
    archive("lod_scale", lod_scale, Range::between(0.05, 20));
    archive("shadow_map_size", shadow_map_size, Range::between(0, 8192));
  }
};

/// The platform of that name where the configuration leaves it open; an empty name changes nothing.
/// Throws Error for a name that is not in yaml_names(GlBackend).
void choose_backend(RendererConfig& config, const std::string& name);

}  // namespace vinebench::sim
