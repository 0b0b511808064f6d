// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/geometry/pose.h"
#include "sim/render/gl/scene/frustum.h"
#include "sim/render/gl/scene/gpu_scene.h"

namespace vinebench::sim {

/// A run of vertices of GpuScene::wires[wires].
struct VisibleWires {
  std::size_t wires = 0;
  GLint first = 0;
  GLsizei count = 0;
};

/// The wires that are in view and thick enough to change a pixel.
std::vector<VisibleWires> visible_wires(const GpuScene& scene, const PinholeCamera& camera,
                                        const Pose& T_world_cam);

}  // namespace vinebench::sim
