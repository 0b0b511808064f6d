// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/geometry/pose.h"
#include "sim/render/gl/scene/frustum.h"
#include "sim/render/gl/scene/gpu_scene.h"
#include "sim/render/gl/shadows/moving_shadow.h"

namespace vinebench::sim {

/// Instances of one model at one level of detail that are drawn by one call a primitive.
struct DrawBatch {
  int shell = 0;  ///< of distance, the nearest first
  int model = 0;
  int level = 0;
  int order = 0;        ///< draw order of the triangles
  bool shaded = false;  ///< the shadow of what moves may fall on them
  bool open = false;    ///< no other shadow can
  std::size_t first = 0;
  std::size_t count = 0;  ///< instances
};

/// What one view draws, the nearest first.
struct DrawList {
  std::vector<DrawBatch> batches;
  std::vector<InstanceRow> rows;  ///< of the batches' instances, the model to the camera
};

/// What moves, as a view has it.
struct MoversInView {
  std::vector<Mover> movers;
  const MovingShadow* shadow = nullptr;  ///< null where none of their shadows is in view
};

/// Culls the instances against the view, chooses each one's level of detail by the distance of its
/// nearest point and the camera's focal length, and batches what is about as far away.
DrawList make_draw_list(const GpuScene& scene, const PinholeCamera& camera, const Pose& T_world_cam,
                        double lod_scale, const MoversInView& moving);

}  // namespace vinebench::sim
