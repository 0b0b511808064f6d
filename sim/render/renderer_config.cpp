// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/renderer_config.h"

#include <algorithm>

#include "core/util/error.h"

namespace vinebench::sim {

void choose_quality(RendererConfig& config, RenderQuality quality) {
  if (quality == RenderQuality::kFast) return;
  config.lod_scale = 3;
  config.supersampling = 2;
}

void choose_backend(RendererConfig& config, const std::string& name) {
  if (name.empty()) return;
  const std::vector<std::string> names = yaml_names(GlBackend{});
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) fail("GL platform '{}': expected auto, osmesa or egl", name);
  if (config.backend == GlBackend::kAuto) {
    config.backend = static_cast<GlBackend>(found - names.begin());
  }
}

}  // namespace vinebench::sim
