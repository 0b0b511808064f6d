// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/render/render_engine.h"
#include "sim/scene/scene.h"

namespace vinebench::sim {

/// Draws a walled court in place of the scene, by geometry alone: for tests of what lies above the
/// renderer, in milliseconds and without OpenGL. The ground is z = 0, the walls stand at |x| or |y|
/// = kHalfWidth and are kWallHeight high; a camera outside sees no walls. Both carry a fixed
/// pattern of squares. Nothing moves, and no rover is seen.
class FakeRenderer : public RenderEngine {
 public:
  static constexpr double kHalfWidth = 30;       ///< m
  static constexpr double kWallHeight = 3;       ///< m
  static constexpr double kGroundSquare = 0.05;  ///< m
  static constexpr double kWallSquare = 0.5;     ///< m

  explicit FakeRenderer(const Scene& scene);

  /// Labels are kGround, kPost and kSky. As instances the ground is the scene's first and the walls
  /// its second, or none where the scene has no such.
  RenderedImage render(const PinholeCamera& camera, const Pose& T_world_cam,
                       const RenderRequest& request) override;

 private:
  int instances_;
};

}  // namespace vinebench::sim
