// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "sim/render/render_engine.h"
#include "sim/render/renderer_config.h"
#include "sim/scene/scene.h"

namespace vinebench::sim {

/// Our own OpenGL 4.2 renderer. Owns a GL context.
class GlRenderer : public RenderEngine {
 public:
  /// Uploads the scene. Throws Error when no context or no memory is to be had.
  GlRenderer(const Scene& scene, const RendererConfig& config);
  GlRenderer(GlRenderer&&) noexcept;
  GlRenderer& operator=(GlRenderer&&) noexcept;
  ~GlRenderer() override;

  RenderedImage render(const PinholeCamera& camera, const Pose& T_world_cam,
                       const RenderRequest& request) override;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vinebench::sim
