// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "sim/render/render_engine.h"
#include "sim/scene/scene.h"

namespace vinebench::sim {

struct MujocoRendererConfig {
  double level_distance = 0;  ///< m, for MujocoScene: 0 takes the finest meshes
  bool shadows = false;       ///< drawn again for each image, as MuJoCo does
};

/// MuJoCo's own renderer on a software context: a second opinion on the same scene. It gives
/// colours, labels, depth and instances (without parts), no normals and no motion; wind does not
/// move its plants, cut-out textures are opaque, and it needs fx = fy. While it draws, no other GL
/// context may be current in that thread.
class MujocoRenderer : public RenderEngine {
 public:
  /// Throws Error when the scene cannot be loaded or there is no context.
  MujocoRenderer(const Scene& scene, const MujocoRendererConfig& config);
  MujocoRenderer(MujocoRenderer&&) noexcept;
  MujocoRenderer& operator=(MujocoRenderer&&) noexcept;
  ~MujocoRenderer() override;

  RenderedImage render(const PinholeCamera& camera, const Pose& T_world_cam,
                       const RenderRequest& request) override;

  std::int64_t triangles() const;
  static std::string platform();  ///< "EGL (surfaceless)" or "OSMesa"

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vinebench::sim
