// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/visible_wires.h"

#include <algorithm>

namespace vinebench::sim {

std::vector<VisibleWires> visible_wires(const GpuScene& scene, const PinholeCamera& camera,
                                        const Pose& T_world_cam) {
  // Minimum width of a wire in the image; thinner ones change less than a grey level.
  constexpr double kThinnest = 0.02;  // px
  const Frustum frustum(camera);
  const Pose T_cam_world = T_world_cam.inverse();
  const double focal_length = std::max(camera.fx, camera.fy);
  std::vector<VisibleWires> visible;
  for (std::size_t i = 0; i < scene.wires.size(); ++i) {
    for (const WireChunk& chunk : scene.wires[i].chunks) {
      const Eigen::Vector3d centre = T_cam_world * chunk.centre;
      const double nearest = std::max(0.0, centre.norm() - chunk.reach);
      if (2 * chunk.thickest * focal_length < kThinnest * nearest) continue;
      if (!frustum.may_see(centre, chunk.reach)) continue;
      const bool goes_on = !visible.empty() && visible.back().wires == i &&
                           visible.back().first + visible.back().count == chunk.first;
      if (goes_on) {
        visible.back().count += chunk.count;
      } else {
        visible.push_back({i, chunk.first, chunk.count});
      }
    }
  }
  return visible;
}

}  // namespace vinebench::sim
