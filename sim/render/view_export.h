// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "core/geometry/camera.h"
#include "core/geometry/pose.h"
#include "sim/assets/asset_file.h"

namespace vinebench::sim {

/// From where another renderer is to look at a scene.
struct ExportedView {
  PinholeCamera camera;
  Pose T_world_cam;
  double lod_scale = 1;  ///< as RendererConfig's
  double reach = 60;     ///< m; what is farther away is left out, but for the ground
};

/// All that stands within reach at time 0, in all directions because it shades and reflects, each
/// at the level of detail that our renderer draws it at.
std::vector<PlacedMesh> meshes_in_reach(const Scene& scene, const ExportedView& view);

/// Adds the wires within reach to the scene, as prisms with four sides, and places them.
void add_wires(Scene& scene, const ExportedView& view, std::vector<PlacedMesh>& placed);

}  // namespace vinebench::sim
