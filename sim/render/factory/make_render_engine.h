// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "sim/render/render_engine.h"
#include "sim/render/renderer_config.h"
#include "sim/scene/scene.h"

namespace vinebench::sim {

/// The engine that the configuration names. Throws Error when it cannot draw here.
std::unique_ptr<RenderEngine> make_render_engine(const Scene& scene, const RendererConfig& config);

}  // namespace vinebench::sim
